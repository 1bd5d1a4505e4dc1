// SPDX-License-Identifier: Apache-2.0
// The gate's own account of consent, where somebody repeats, crosses or delays what an operator says.
#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

#include "tests/safety/gate_fixture.hpp"

namespace striker::safety {
namespace {

class GateConsent : public GateRules {};

TEST_F(GateConsent, AfterItsTimeARenewalComesTooLate) {
  drive();
  feed(10'102);
  for (int renewal = 0; renewal < 5; ++renewal) {
    feed();
    order(renew, 0);
  }
  EXPECT_FALSE(moves()) << "consent ended; only another confirmation brings it back";
}

TEST_F(GateConsent, TheLastTickOfItsTimeCounts) {
  drive();
  feed(10'100);
  gate.take({}, tick);
  EXPECT_TRUE(moves());
}

TEST_F(GateConsent, AnyNumberButNoneMayBeTheChallenge) {
  for (const std::int32_t number : {1, 2, 255}) {
    feed(13);
    challenge(arm, number);
    order(arm, number);
    EXPECT_TRUE(moves()) << number;
    order(disarm, 0);
  }
}

TEST_F(GateConsent, AClearArmsNothing) {
  feed(13);
  confirm(clear);
  EXPECT_FALSE(moves()) << "with nothing to clear, and not armed";
  confirm(clear);
  drive();
  can::SendCounter counter;
  receive(can::send(can::EmergencyStop{}, counter));
  feed(151);
  confirm(clear);
  EXPECT_FALSE(moves()) << "what was armed before a stop is so no longer";
}

TEST_F(GateConsent, AStopOutlastsARestartAndHoldsAsLongAfterIt) {
  can::SendCounter counter;
  for (const std::uint32_t wait : {0U, 150U, 151U}) {
    receive(can::send(can::EmergencyStop{}, counter));
    gate.restart();
    tick = 0;
    feed(wait);
    confirm(clear);
    feed(13);
    confirm(arm);
    EXPECT_EQ(moves(), wait == 151) << wait;
  }
}

// Of an operator who is dead: the same bytes again and again, or two old frames in turn.
TEST_F(GateConsent, RenewalsThatAreRepeatedRenewNothing) {
  for (const std::size_t frames : {1U, 2U}) {
    can::SendCounter counter{.next = 9};
    std::vector<can::Frame> old;
    for (std::size_t i = 0; i < frames; ++i) {
      old.push_back(can::send(can::ModeCommand{.mode = renew}, counter));
    }
    confirm(clear);
    drive();
    for (std::size_t second = 0; second < 10; ++second) {
      feed(1'000);
      receive(old[second % frames]);
    }
    feed(102);
    EXPECT_FALSE(moves()) << frames;
    confirm(clear);
  }
}

TEST_F(GateConsent, AClearWithNothingToClearLeavesTheCause) {
  drive();
  confirm(clear);
  EXPECT_TRUE(moves());
}

// The controller, which the gate does not believe, asks to confirm what is neither an arming nor a clear.
TEST_F(GateConsent, OnlyAConfirmedClearClears) {
  can::SendCounter counter;
  for (const std::int32_t mode : {disarm, renew, arm}) {
    receive(can::send(can::EmergencyStop{}, counter));
    feed(151);
    confirm(mode);
    confirm(arm);
    EXPECT_FALSE(moves()) << mode;
  }
}

TEST_F(GateConsent, AClearSoSoonAfterAStopClearsNothing) {
  can::SendCounter counter;
  for (const std::uint32_t wait : {0U, 1U, 150U, 151U}) {
    order(disarm, 0);
    receive(can::send(can::EmergencyStop{}, counter));
    feed(wait);
    confirm(clear);
    confirm(arm);
    EXPECT_EQ(moves(), wait == 151) << wait;
  }
}

TEST_F(GateConsent, TheLastConfirmationOfATickCountsAndADisarmBeatsIt) {
  feed(13);
  can::SendCounter counter;
  const auto confirmation = [&](std::int32_t mode, std::int32_t number) {
    return can::send(can::ModeCommand{.mode = mode, .challenge = number}, counter);
  };
  challenge(arm, 77);
  gate.take(std::array{confirmation(arm, 76), confirmation(arm, 77)}, tick);
  EXPECT_TRUE(moves());
  for (const bool disarm_first : {true, false}) {
    challenge(arm, 78);
    std::array frames = {confirmation(arm, 78), confirmation(disarm, 0)};
    if (disarm_first) {
      std::swap(frames[0], frames[1]);
    }
    gate.take(frames, tick);
    EXPECT_FALSE(moves());
    feed(200);
    confirm(clear);
  }
}

}  // namespace
}  // namespace striker::safety
