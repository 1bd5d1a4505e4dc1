// SPDX-License-Identifier: Apache-2.0
// How long a team's orders are good, and what old, repeated and broken frames are worth, attacked from outside. The node
// stands behind its gate, as on every port.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/loop/bench/team_rig.hpp"

namespace striker::loop {
namespace {

using core::OrderState;
using core::State;
using core::WheelSpeeds;

constexpr std::uint32_t good_ticks = 150;

TEST(OldOrder, AnOrderIsGoodFor150MillisecondsAndNotForOneMore) {
  TeamRig rig = driving();
  rig.order.reset();
  EXPECT_EQ(moved_until(rig, 5'000, [](std::uint32_t) {}), good_ticks);
  EXPECT_EQ(rig.state(), State::active) << "no order is no fault";
  EXPECT_EQ(rig.orders(), OrderState::lapsed) << "the policy does not come back by itself";
}

// The wheel loops bring the robot to a stand, where torque 0 would let it roll.
TEST(OldOrder, WithoutAGoodOrderTheRobotBrakes) {
  TeamRig rig = driving();
  rig.wheels = {.left_mm_s = 300, .right_mm_s = 200};
  rig.order.reset();
  rig.live(good_ticks + 3);
  EXPECT_FALSE(rig.is_told_to_move());
  EXPECT_LT(rig.command.left_torque_mNm, 0);
  EXPECT_LT(rig.command.right_torque_mNm, 0);
}

TEST(OldOrder, WhatWaitedInAQueueIsAsOldAsItIs) {
  for (const int age_ms : {0, 1, 100, 149, 150, 151, 254, 255}) {
    TeamRig rig = driving();
    rig.live(40);
    rig.say(can::WheelOrder{.left_mm_s = 500});
    rig.extra.back().age_ms = static_cast<std::uint8_t>(age_ms);
    rig.order.reset();
    const std::uint32_t moved = moved_until(rig, 1'000, [](std::uint32_t) {});
    // Too old an order leaves the one before it.
    const int expected = age_ms <= 150 ? 150 - age_ms + 1 : 110;
    EXPECT_EQ(moved, static_cast<std::uint32_t>(expected)) << age_ms;
  }
}

TEST(OldOrder, AFrozenOrderInTheTeamsPlaceIsNeverGood) {
  for (const std::uint32_t period : {1U, 2U, 10U, 50U, 100U, 149U}) {
    TeamRig rig = driving();
    const can::Frame frozen = rig.delivered.front();
    ASSERT_TRUE(can::is<can::WheelOrder>(frozen));
    rig.order.reset();
    const auto repeat = [&](std::uint32_t tick) {
      if (tick % period == 0) {
        rig.extra.push_back(frozen);
      }
    };
    EXPECT_LE(moved_until(rig, 60'000, repeat), good_ticks) << period;
    EXPECT_EQ(rig.orders(), OrderState::lapsed);
  }
}

TEST(OldOrder, ASetOfUpToFiveOldOrdersInAnyOrderIsGoodForOneRoundAtMost) {
  std::mt19937 random(1);
  for (std::uint32_t count = 2; count <= 5; ++count) {
    for (int trial = 0; trial < 20; ++trial) {
      TeamRig rig = driving();
      std::vector<can::Frame> old;
      while (old.size() < count) {
        rig.live_to_an_order();
        old.push_back(rig.delivered.front());
      }
      std::shuffle(old.begin(), old.end(), random);
      rig.order.reset();
      const auto repeat = [&](std::uint32_t tick) {
        if (tick % 50 == 0) {
          rig.extra.push_back(old[tick / 50 % count]);
        }
      };
      EXPECT_LE(moved_until(rig, 20'000, repeat), good_ticks + 50 * count);
    }
  }
}

// An old frame that is just ahead of the team's counter is the team's next one, for all that can be known: it stands
// until the team's own comes, at most, and never again while it is repeated.
TEST(OldOrder, AnOldOrderBesideTheTeamsOwnStandsForOneOfItsPeriodsAtMost) {
  for (std::uint32_t counter = 0; counter < can::counter_modulus; ++counter) {
    for (const std::uint32_t period : {1U, 7U, 50U, 800U}) {
      TeamRig rig = driving();
      can::SendCounter recorded{static_cast<std::uint8_t>(counter)};
      const can::Frame old = can::send(can::WheelOrder{.left_mm_s = -900, .right_mm_s = -900}, recorded);
      rig.order = can::WheelOrder{};
      rig.live_to_an_order();
      std::uint32_t acted = 0;
      for (std::uint32_t tick = 0; tick < 10'000; ++tick) {
        if (tick % period == period - 1) {
          rig.extra.push_back(old);
        }
        rig.live();
        acted += rig.is_told_to_move() ? 1 : 0;
      }
      const std::uint32_t rounds = period == 800 ? 12 : 1;  // in between the team is believed again
      EXPECT_LE(acted, 50U * rounds) << counter << " every " << period;
    }
  }
}

TEST(OldOrder, TwoTeamsOnOneBusOrderNothing) {
  for (std::uint8_t lead = 0; lead < can::counter_modulus; ++lead) {
    TeamRig rig = driving();
    can::SendCounter other{static_cast<std::uint8_t>((rig.team().next + lead) % can::counter_modulus)};
    const auto speak = [&](std::uint32_t tick) {
      if (tick % 50 == 25) {
        rig.extra.push_back(can::send(can::WheelOrder{.left_mm_s = -500}, other));
      }
    };
    EXPECT_LE(moved_until(rig, 5'000, speak), 150U) << int{lead};
  }
}

TEST(OldOrder, ABrokenOrderIsNotTakenAndThreeOfThemEndTheLast) {
  for (std::size_t bit = 0; bit < 48; ++bit) {
    TeamRig rig = driving();
    for (int wrong = 1; wrong <= 3; ++wrong) {
      rig.say(can::WheelOrder{.left_mm_s = 800, .right_mm_s = 800});
      rig.extra.back().data[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
      rig.order.reset();
      rig.live();
      EXPECT_EQ(rig.set_point(), wrong < 3 ? as_ordered : WheelSpeeds{}) << bit;
    }
  }
}

TEST(OldOrder, ALostOrderOrTwoCostNothing) {
  TeamRig rig = driving();
  for (std::uint32_t lost = 0; lost < 9; ++lost) {
    for (int whole = 0; whole < 8; ++whole) {
      rig.live_to_an_order();
    }
    const auto said = rig.order;
    for (std::uint32_t i = 0; i < lost % 3; ++i) {
      static_cast<void>(rig.next_frame());
    }
    rig.order.reset();
    const auto is_still = [&](std::uint32_t) { ASSERT_EQ(rig.set_point(), as_ordered) << lost; };
    moved_until(rig, 50 * (lost % 3), is_still);
    rig.order = said;
    moved_until(rig, 50, is_still);
  }
}

TEST(OldOrder, AfterASilenceOrdersEarnTheirBeliefAnew) {
  TeamRig rig = driving();
  rig.order.reset();
  rig.live(400);
  rig.order = ahead;
  for (int frame = 1; frame <= 6; ++frame) {
    rig.live_to_an_order();
    EXPECT_EQ(rig.is_told_to_move(), frame >= 6) << frame;
  }
}

// Behind a contradiction nothing of its tick is obeyed.
TEST(OldOrder, AnOrderThatIsContradictedInItsTickIsNotObeyed) {
  TeamRig rig = driving();
  rig.say(can::WheelOrder{.left_mm_s = 700});
  can::SendCounter same{static_cast<std::uint8_t>((rig.team().next + 15) % can::counter_modulus)};
  rig.extra.push_back(can::send(can::WheelOrder{.left_mm_s = -700}, same));
  rig.live();
  EXPECT_FALSE(rig.is_told_to_move());
}

TEST(OldOrder, TimeThatLeapsEndsAnOrder) {
  TeamRig rig = driving();
  rig.order.reset();
  rig.skip(151);
  rig.send_vision = false;
  rig.live();
  EXPECT_FALSE(rig.is_told_to_move());
}

}  // namespace
}  // namespace striker::loop
