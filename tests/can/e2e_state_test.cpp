// SPDX-License-Identifier: Apache-2.0
// The E2E state machine: what is believed after what was lost, repeated, wrong or old.
#include "firmware/can/e2e_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace striker::can {
namespace {

using Fast = E2eMachine<fast_window>;
using Slow = E2eMachine<slow_window>;

template <class Machine>
Machine believed(std::uint8_t& next) {
  Machine machine;
  for (int i = 0; i < 40; ++i) {
    machine.take_correct(next, true);
    next = static_cast<std::uint8_t>((next + 1) % counter_modulus);
  }
  EXPECT_EQ(machine.state(), E2eState::valid);
  return machine;
}

TEST(E2eState, GoesFromNoDataThroughInitToValid) {
  Fast machine;
  EXPECT_EQ(machine.state(), E2eState::no_data);
  EXPECT_FALSE(machine.take_correct(5, true));
  EXPECT_EQ(machine.state(), E2eState::init);
  EXPECT_FALSE(machine.take_correct(6, true));
  EXPECT_FALSE(machine.take_correct(7, true));
  EXPECT_TRUE(machine.take_correct(8, true));
  EXPECT_EQ(machine.state(), E2eState::valid);
}

TEST(E2eState, ARepeatedFrameIsNeverTaken) {
  std::uint8_t next = 3;
  Fast machine = believed<Fast>(next);
  const auto last = static_cast<std::uint8_t>((next + 15) % 16);
  for (int i = 0; i < 1'000; ++i) {
    ASSERT_FALSE(machine.take_correct(last, false));
  }
  EXPECT_EQ(machine.state(), E2eState::invalid);
}

// A CAN controller may hear the last bit of a frame otherwise than its sender, and get it twice.
TEST(E2eState, AFrameThatCameTwiceCostsNoMoreThanALostOneButOtherDataUnderItsCounterAll) {
  for (const bool differs : {false, true}) {
    std::uint8_t next = 3;
    Fast machine = believed<Fast>(next);
    EXPECT_FALSE(machine.take_correct(static_cast<std::uint8_t>((next + 15) % 16), differs));
    EXPECT_EQ(machine.state(), differs ? E2eState::invalid : E2eState::valid);
    EXPECT_EQ(machine.take_correct(next, true), !differs);
  }
}

TEST(E2eState, AQuarterMayBeLost) {
  for (std::uint32_t every : {4U, 5U, 8U, 16U}) {
    std::uint8_t next = 0;
    Fast machine = believed<Fast>(next);
    for (std::uint32_t i = 0; i < 1'000; ++i, next = static_cast<std::uint8_t>((next + 1) % 16)) {
      if (i % every != 0) {
        const bool after_a_gap = i % every == 1;
        ASSERT_EQ(machine.take_correct(next, true), !after_a_gap) << "one in " << every << " lost";
        ASSERT_EQ(machine.state(), E2eState::valid);
      }
    }
  }
  std::uint8_t next = 0;
  Fast machine = believed<Fast>(next);
  for (std::uint32_t i = 0; i < 1'000; ++i, next = static_cast<std::uint8_t>((next + 1) % 16)) {
    if (i % 3 != 0) {
      machine.take_correct(next, true);
    }
  }
  EXPECT_EQ(machine.state(), E2eState::invalid) << "one in 3 lost";
}

// Wherever the sender starts again, it is believed after twelve steps, and not before.
TEST(E2eState, WhatComesBackIsBelievedAfterTwelveSteps) {
  for (std::uint8_t start = 0; start < 16; ++start) {
    std::uint8_t next = 0;
    Fast machine = believed<Fast>(next);
    machine.forget();
    int taken_at = 0;
    for (int i = 1; i <= 20 && taken_at == 0; ++i) {
      taken_at = machine.take_correct(static_cast<std::uint8_t>((start + i) % 16), true) ? i : 0;
    }
    EXPECT_GE(taken_at, 12);
    EXPECT_LE(taken_at, 13) << "the very first may look like a repetition";
  }
}

TEST(E2eState, SilenceIsNoError) {
  std::uint8_t next = 0;
  Fast machine = believed<Fast>(next);
  machine.forget();
  EXPECT_EQ(machine.state(), E2eState::init);
}

// Every set of so few old frames, in random orders, for ever: by count, not by the machine's own rule.
template <class Machine>
void expect_old_sets_refused(std::size_t most, std::uint32_t window) {
  std::mt19937 random(7);
  for (std::size_t count = 1; count <= most; ++count) {
    for (int trial = 0; trial < 300; ++trial) {
      std::vector<std::uint8_t> counters(16);
      for (std::uint8_t i = 0; i < 16; ++i) {
        counters[i] = i;
      }
      std::shuffle(counters.begin(), counters.end(), random);
      counters.resize(count);
      if (trial % 2 == 0) {
        std::sort(counters.begin(), counters.end());
      }
      std::uint8_t next = 0;
      Machine machine = believed<Machine>(next);
      for (std::uint32_t i = 0; i < 500; ++i) {
        const bool taken = machine.take_correct(counters[i % count], trial % 3 == 0);
        ASSERT_FALSE(taken && i > window) << count << " old frames, step " << i;
      }
    }
  }
}

TEST(E2eState, UpToElevenOldFramesOfAFastMessageAreNeverBelieved) {
  expect_old_sets_refused<Fast>(11, 16);
}

TEST(E2eState, UpToFiveOldPicturesAreNeverBelieved) {
  expect_old_sets_refused<Slow>(5, 8);
}

TEST(E2eState, WrongFramesBetweenCorrectOnesEndBelief) {
  std::uint8_t next = 0;
  Fast machine = believed<Fast>(next);
  for (int i = 0; i < 20; ++i, next = static_cast<std::uint8_t>((next + 1) % 16)) {
    machine.take_wrong();
    machine.take_correct(next, true);
  }
  EXPECT_EQ(machine.state(), E2eState::invalid);
}

}  // namespace
}  // namespace striker::can
