// SPDX-License-Identifier: Apache-2.0
// The E2E state machine against an account of the same rules that keeps a list of counts; and a message's receiver
// at its time-out.
#include "firmware/can/e2e_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>

#include "firmware/can/message_receiver.hpp"

namespace striker::can {
namespace {

class Account {
 public:
  explicit Account(const E2eWindow& limits) : limits_(limits), window_(limits.counts, false) {}

  bool take_correct(int counter, bool differs) {
    if (state == E2eState::no_data) {
      state = E2eState::init;
      last_ = counter;
      for (int i = 0; i < limits_.least_correct - limits_.least_first; ++i) {
        push(true);
      }
      return false;
    }
    const int advance = silent_ ? 1 : (counter - last_ + 16) % 16;
    silent_ = false;
    last_ = counter;
    // Another sender: the same counter with other data, or a leap after which a full window would not do.
    if ((advance == 0 && differs) || limits_.counts - advance + 1 < limits_.least_correct) {
      window_.assign(limits_.counts, false);
      alone_ = 0;
    } else {
      for (int lost = 1; lost < advance; ++lost) {
        push(false);
      }
      push(advance != 0);
      alone_ += advance != 0 ? 1 : 0;
    }
    judge();
    return advance != 0 && advance <= limits_.greatest_step && state == E2eState::valid;
  }
  void take_wrong() {
    push(false);
    judge();
  }
  void forget() {
    window_.assign(limits_.counts, false);
    silent_ = true;
    state = state == E2eState::no_data ? E2eState::no_data : E2eState::init;
  }

  E2eState state = E2eState::no_data;

 private:
  void push(bool correct) {
    window_.push_back(correct);
    window_.pop_front();
  }
  void judge() {
    if (state == E2eState::no_data) {
      return;
    }
    const auto correct = std::count(window_.begin(), window_.end(), true);
    if (correct >= limits_.least_correct && alone_ >= limits_.steps_alone) {
      state = E2eState::valid;
    } else if (state == E2eState::valid) {
      state = E2eState::invalid;
    }
  }

  E2eWindow limits_;
  std::deque<bool> window_;
  int last_ = 0;
  bool silent_ = false;
  int alone_ = 255;  // steps since the last contradiction
};

// Runs of mostly good frames, so that every state is met.
template <E2eWindow limits>
void compare(std::uint32_t seed) {
  std::mt19937 engine(seed);
  const auto random = [&engine] { return static_cast<std::uint32_t>(engine()); };
  E2eMachine<limits> machine;
  Account account(limits);
  std::uint8_t counter = static_cast<std::uint8_t>(random() % 16);
  for (int i = 0; i < 1'500; ++i) {
    const std::uint32_t luck = random() % 100;
    const std::uint32_t bad = seed % 40;
    if (luck == 0) {
      machine.forget();
      account.forget();
    } else if (luck < bad / 2) {
      machine.take_wrong();
      account.take_wrong();
    } else {
      counter = static_cast<std::uint8_t>((counter + (luck < bad ? random() % 16 : 1)) % 16);
      const bool differs = random() % 2 == 0;
      ASSERT_EQ(machine.take_correct(counter, differs), account.take_correct(counter, differs))
          << seed << " " << i;
    }
    ASSERT_EQ(machine.state(), account.state) << seed << " " << i;
  }
}

TEST(E2eRules, FollowsItsRules) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    compare<fast_window>(seed);
    compare<command_window>(seed);
    compare<slow_window>(seed);
  }
}

// As a drive sees them. Of sixteen counts four are missing, and the twelve that are there are enough.
TEST(E2eRules, CommandsAreBelievedWhileAQuarterIsLostAndTheOneAfterAGapWaits) {
  E2eMachine<command_window> commands;
  int counter = 0;
  for (; counter < 32; ++counter) {
    commands.take_correct(static_cast<std::uint8_t>(counter % 16), true);
  }
  for (; counter < 232; ++counter) {
    if (counter % 4 == 0) {
      continue;
    }
    EXPECT_EQ(commands.take_correct(static_cast<std::uint8_t>(counter % 16), true), counter % 4 != 1)
        << counter;
    EXPECT_EQ(commands.state(), E2eState::valid) << counter;
  }
}

TEST(E2eRules, WithoutAFrameThereIsNoState) {
  E2eMachine<fast_window> machine;
  for (int i = 0; i < 20; ++i) {
    machine.take_wrong();
    machine.forget();
  }
  EXPECT_EQ(machine.state(), E2eState::no_data);
}

TEST(E2eRules, ThreeStepsAfterPowerOnAndTwelveAfterATimeOut) {
  E2eMachine<fast_window> machine;
  std::uint8_t counter = 0;
  const auto steps_until_taken = [&] {
    int steps = 0;
    while (!machine.take_correct(static_cast<std::uint8_t>(counter++ % 16), true)) {
      ++steps;
    }
    return steps;
  };
  EXPECT_EQ(steps_until_taken(), 3);
  machine.forget();
  EXPECT_EQ(machine.state(), E2eState::init);
  EXPECT_EQ(steps_until_taken(), 11);
}

TEST(E2eRules, FastMessagesHaveTheLongWindow) {
  EXPECT_EQ(window_for(10).counts, 16);
  EXPECT_EQ(window_for(11).counts, 8);
  EXPECT_EQ(fast_window.least_correct, 12);
  EXPECT_EQ(fast_window.least_first, 3);
  EXPECT_EQ(command_window.least_first, 12);
  EXPECT_EQ(fast_window.greatest_step, 1);
  EXPECT_EQ(slow_window.greatest_step, 3);
  EXPECT_EQ(fast_window.steps_alone, 12);
  EXPECT_EQ(command_window.steps_alone, 100);
  EXPECT_EQ(slow_window.steps_alone, 6);
  EXPECT_EQ(slow_window.least_correct, 6);
  EXPECT_EQ(slow_window.least_first, 2);
}

class WheelStates : public testing::Test {
 protected:
  MessageReceiver<WheelState> receiver;
  SendCounter counter;
  WheelState taken;
  std::uint32_t tick = 100;

  Verdict take(std::int32_t speed_mm_s, std::uint8_t age_ms = 0) {
    Frame frame = send(WheelState{.left_mm_s = speed_mm_s}, counter);
    frame.age_ms = age_ms;
    return receiver.take(frame, tick, taken);
  }
  void run() {
    for (int i = 0; i < 20; ++i) {
      ++tick;
      static_cast<void>(take(1));
    }
    ASSERT_EQ(taken.left_mm_s, 1);
  }
};

TEST_F(WheelStates, AreBelievedAnewAfterTheirTimeOutAndNotAtIt) {
  run();
  tick += 20;
  EXPECT_EQ(take(2), Verdict::accepted);
  tick += 21;
  EXPECT_EQ(take(3), Verdict::wrong_counter);
  EXPECT_FALSE(receiver.invalid()) << "a silence is no error of what comes";
  EXPECT_EQ(taken.left_mm_s, 2) << "nothing of it is taken";
}

TEST_F(WheelStates, CountFromWhenTheyWereReceived) {
  run();
  tick += 25;
  EXPECT_EQ(take(2, 5), Verdict::accepted);
  tick += 16;
  EXPECT_EQ(take(3), Verdict::wrong_counter) << "21 ms after the last was received";
}

// 255 ms is the greatest age that a frame is given: the port handed over an older one after a newer.
TEST_F(WheelStates, OneThatWaitedAsLongAsAFrameCanIsNoSilence) {
  run();
  EXPECT_EQ(take(2, 255), Verdict::accepted);
}

TEST_F(WheelStates, WrongOnesCountAgainstThemAndKeepTheTimeOutAway) {
  run();
  for (int i = 0; i < 4; ++i) {
    EXPECT_FALSE(receiver.invalid());
    Frame wrong = send(WheelState{}, counter);
    counter.next = static_cast<std::uint8_t>((counter.next + 15) % 16);
    wrong.data[0] ^= 1U;
    tick += 20;
    EXPECT_EQ(receiver.take(wrong, tick, taken), Verdict::wrong_crc);
  }
  EXPECT_FALSE(receiver.invalid()) << "twelve of sixteen";
  Frame wrong = send(WheelState{}, counter);
  wrong.data[0] ^= 1U;
  EXPECT_EQ(receiver.take(wrong, tick, taken), Verdict::wrong_crc);
  EXPECT_TRUE(receiver.invalid());
}

}  // namespace
}  // namespace striker::can
