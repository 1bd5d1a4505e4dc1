// SPDX-License-Identifier: Apache-2.0
// What must never move a wheel, attacked from outside: each test is named after what is promised, and says for
// itself what is fresh, valid or consented to. The node stands behind its gate, as on every port.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/loop/bench/node_rig.hpp"

namespace striker::loop {
namespace {

using can::Mode;
using core::Fault;
using core::State;

constexpr bool has(core::Faults faults, Fault fault) {
  return (faults & core::set_of(fault)) != 0;
}

NodeRig armed() {
  NodeRig rig;
  rig.arm();
  rig.run(30);
  EXPECT_TRUE(rig.torque()) << "the rig has to drive";
  return rig;
}

// Frames that were recorded from the rig's own drives, in their order.
std::vector<can::Frame> old_wheel_states(NodeRig& rig, std::size_t count) {
  std::vector<can::Frame> frames;
  while (frames.size() < count) {
    rig.tick();
    frames.push_back(rig.delivered.front());
  }
  return frames;
}

TEST(Promise, AFrozenWheelStateIsNeverFresh) {
  for (const std::uint32_t period : {1U, 2U, 5U, 10U, 20U}) {
    NodeRig rig = armed();
    const can::Frame frozen = old_wheel_states(rig, 1).front();
    rig.send_wheels = false;
    std::uint32_t moved_until = 0;
    for (std::uint32_t tick = 1; tick <= 60'000; ++tick) {
      if (tick % period == 0) {
        rig.extra.push_back(frozen);
      }
      rig.tick();
      moved_until = rig.torque() ? tick : moved_until;
    }
    EXPECT_LE(moved_until, 25U) << "every " << period << " ms";
    EXPECT_EQ(rig.state(), State::fault);
  }
}

TEST(Promise, ASetOfUpToElevenOldWheelStatesInAnyOrderIsNeverFresh) {
  std::mt19937 random(1);
  for (std::size_t count = 2; count <= 11; ++count) {
    for (int trial = 0; trial < 20; ++trial) {
      NodeRig rig = armed();
      std::vector<can::Frame> old = old_wheel_states(rig, count);
      std::shuffle(old.begin(), old.end(), random);
      rig.send_wheels = false;
      std::uint32_t moved_until = 0;
      for (std::uint32_t tick = 1; tick <= 2'000; ++tick) {
        rig.extra.push_back(old[tick % count]);
        rig.tick();
        moved_until = rig.torque() ? tick : moved_until;
      }
      EXPECT_LE(moved_until, 25U + count) << count;
      EXPECT_EQ(rig.fault(), Fault::wheel_state_invalid);
    }
  }
}

// Two senders of one message, each with honest counters and protection of its own.
TEST(Promise, AnImpostorsWheelStatesAreNotObeyed) {
  for (std::uint8_t lead = 0; lead < can::counter_modulus; ++lead) {
    NodeRig rig = armed();
    std::uint32_t moved_until = 0;
    for (std::uint32_t tick = 1; tick <= 5'000; ++tick) {
      const auto counter = static_cast<std::uint8_t>(can::counter_of(rig.delivered.front()) + 1 + lead);
      can::SendCounter impostor{static_cast<std::uint8_t>(counter % can::counter_modulus)};
      rig.extra.push_back(can::send(can::WheelState{.left_mm_s = -100, .right_mm_s = 100}, impostor));
      rig.tick();
      moved_until = rig.torque() ? tick : moved_until;
    }
    EXPECT_LE(moved_until, 50U) << int{lead};
    EXPECT_TRUE(has(rig.faults(), Fault::wheel_state_invalid)) << int{lead};
  }
}

TEST(Promise, AFrozenPictureIsNeverFresh) {
  for (std::size_t count = 1; count <= 5; ++count) {
    NodeRig rig = armed();
    std::vector<std::vector<can::Frame>> old;
    while (old.size() < count) {
      rig.tick();
      if (rig.delivered.size() == 3) {
        old.push_back({rig.delivered[1], rig.delivered[2]});
      }
    }
    rig.send_vision = false;
    std::uint32_t moved_until = 0;
    for (std::uint32_t tick = 1; tick <= 20'000; ++tick) {
      if (tick % 50 == 0) {
        const auto& picture = old[tick / 50 % count];
        rig.extra.insert(rig.extra.end(), picture.begin(), picture.end());
      }
      rig.tick();
      moved_until = rig.torque() ? tick : moved_until;
    }
    EXPECT_LE(moved_until, 200U + 50U * static_cast<std::uint32_t>(count)) << count;
    EXPECT_EQ(rig.state(), State::fault);
  }
}

// A stall of the process: what waited meanwhile is as old as it is.
TEST(Promise, WhatWaitedInAQueueIsAsOldAsItIs) {
  NodeRig rig = armed();
  rig.send_wheels = false;
  can::SendCounter counter{static_cast<std::uint8_t>(can::counter_of(rig.delivered.front()) + 1)};
  std::uint32_t moved = 0;
  for (std::uint32_t tick = 0; tick < 200; ++tick) {
    can::Frame late = can::send(can::WheelState{}, counter);
    late.age_ms = 30;
    rig.extra.push_back(late);
    rig.tick();
    moved += rig.torque() && tick > 25 ? 1U : 0U;
  }
  EXPECT_EQ(moved, 0U);
  EXPECT_EQ(rig.fault(), Fault::wheel_state_lost);
}

TEST(Promise, AStopIsLatchedBesideAnyOtherFault) {
  NodeRig rig = armed();
  rig.send_vision = false;
  rig.run(200);
  ASSERT_EQ(rig.fault(), Fault::vision_lost);
  rig.stop();
  rig.tick();
  EXPECT_EQ(rig.fault(), Fault::vision_lost) << "the first stays first";
  EXPECT_TRUE(has(rig.faults(), Fault::emergency_stop));
  can::Safety told;
  for (const can::Frame& frame : rig.frames()) {
    static_cast<void>(can::is<can::Safety>(frame) && can::receive(frame, told) == can::Verdict::accepted);
  }
  EXPECT_TRUE(has(static_cast<core::Faults>(told.faults), Fault::emergency_stop)) << "and is told";
}

TEST(Promise, AHeldButtonLeavesNoGapForAClear) {
  NodeRig rig = armed();
  can::SendCounter counter;
  const can::Frame pressed = can::send(can::EmergencyStop{}, counter);
  for (std::uint32_t tick = 0; tick < 2'000; ++tick) {
    if (tick % 10 == 0) {
      rig.extra.push_back(pressed);
    }
    if (tick % 7 == 3) {
      rig.mode(Mode::clear);
    }
    rig.tick();
    ASSERT_EQ(rig.state(), State::fault) << tick;
  }
}

TEST(Promise, WrongFramesOnAnOperatorsIdentifierAreAFault) {
  NodeRig rig = armed();
  can::SendCounter counter;
  can::Frame wrong = can::send(can::EmergencyStop{}, counter);
  wrong.data[0] ^= 1U;
  for (std::uint32_t tick = 0; tick < 20; ++tick) {
    rig.extra.push_back(wrong);
    rig.tick();
  }
  EXPECT_EQ(rig.fault(), Fault::operator_invalid);
  EXPECT_FALSE(rig.torque());
}

TEST(Promise, AStuckOperatorsFrameDoesNotBlockADisarm) {
  for (const Mode stuck : {Mode::arm, Mode::clear, Mode::renew}) {
    for (std::uint8_t counter = 0; counter < can::counter_modulus; ++counter) {
      NodeRig rig = armed();
      can::SendCounter at{counter};
      const can::Frame frame = can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(stuck)}, at);
      for (std::uint32_t tick = 0; tick < 100; ++tick) {
        rig.extra.push_back(frame);
        rig.tick();
      }
      rig.extra.push_back(frame);
      rig.mode(Mode::disarm);
      rig.tick();
      EXPECT_NE(rig.state(), State::active) << int{counter};
    }
  }
}

TEST(Promise, BeingArmedEndsWithoutARenewal) {
  NodeRig rig = armed();
  std::uint32_t driven = 0;
  for (std::uint32_t tick = 0; tick < 12'000; ++tick) {
    rig.tick();
    driven += rig.torque() ? 1U : 0U;
  }
  EXPECT_EQ(rig.fault(), Fault::dead_man);
  EXPECT_LE(driven, core::armed_limit_ticks);
  NodeRig held = armed();
  for (std::uint32_t tick = 0; tick < 30'000; ++tick) {
    if (tick % 1'000 == 0) {
      held.mode(Mode::renew);
    }
    held.tick();
  }
  EXPECT_EQ(held.state(), State::active);
}

TEST(Promise, ASecondControllerOnTheBusIsAFault) {
  for (const bool commands : {true, false}) {
    NodeRig rig = armed();
    NodeRig other;
    other.run(20);
    rig.extra.push_back(commands ? other.frames().back() : can::pack(can::Status{}));
    rig.tick();
    EXPECT_EQ(rig.fault(), Fault::second_controller);
    EXPECT_FALSE(rig.torque());
    rig.mode(Mode::clear);
    rig.tick();
    EXPECT_EQ(rig.state(), State::fault) << "it may still be there";
    rig.run(core::second_controller_hold_ticks);
    rig.mode(Mode::clear);
    rig.tick();
    EXPECT_EQ(rig.state(), State::standby);
  }
}

TEST(Promise, DrivesThatCutTheTorqueByThemselvesAreAFault) {
  NodeRig rig = armed();
  rig.wheels.torque_cut = 1;
  rig.run(core::drives_cut_limit_ticks + 2);
  EXPECT_EQ(rig.fault(), Fault::drives_cut);
}

TEST(Promise, TimeThatGoesBackIsAFault) {
  NodeRig rig = armed();
  rig.answer({.number = rig.now() - 5});
  EXPECT_EQ(rig.fault(), Fault::clock_invalid);
  EXPECT_FALSE(rig.torque());
}

// Whatever the clock does meanwhile, a clear within the hold of a stop changes nothing.
TEST(Promise, AClockThatGoesBackDoesNotShortenAStopsHold) {
  NodeRig rig = armed();
  rig.stop();
  rig.tick();
  rig.answer({.number = rig.now() - 100});
  for (int tick = 0; tick < 45; ++tick) {  // each takes two ticks
    rig.mode(Mode::clear);
    rig.tick();
    ASSERT_EQ(rig.faults() & core::set_of(Fault::emergency_stop), core::set_of(Fault::emergency_stop))
        << tick;
  }
}

TEST(Promise, InputsOfTheDistantPastDoNotBecomeFreshAgain) {
  NodeRig rig;
  rig.run(210);
  for (const std::uint32_t jump : {0x7FFFFF00U, 0x7FFFFF00U, 0x200U}) {  // once around
    rig.answer({.number = rig.now() - 1 + jump});
    rig.skip(jump);
  }
  rig.mode(Mode::arm);
  rig.send_wheels = false;
  rig.send_vision = false;
  rig.tick();
  EXPECT_NE(rig.state(), State::active);
}

TEST(Promise, WhatThePortLostIsCountedAndAFault) {
  NodeRig rig = armed();
  rig.answer({.number = rig.now(), .port_faults = core::set_of(Fault::frames_lost), .lost_frames = 3});
  EXPECT_EQ(rig.fault(), Fault::frames_lost);
  EXPECT_FALSE(rig.torque());
}

}  // namespace
}  // namespace striker::loop
