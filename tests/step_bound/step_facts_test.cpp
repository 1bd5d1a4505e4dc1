// SPDX-License-Identifier: Apache-2.0
// What tools/step_bound/facts.toml says of the controller's step, proved from outside: by every case where there are few
// enough, by the whole range of what decides otherwise.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <map>

#include "firmware/can/reporter.hpp"
#include "firmware/core/decision_clock.hpp"
#include "firmware/core/supervision/command_check.hpp"
#include "firmware/core/supervision/supervisor.hpp"
#include "firmware/core/wheel_loop.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/gated_node.hpp"

namespace striker {
namespace {

using core::Fault;
using core::State;

// Every supervisor with any one fault, and every condition with any one cause.
template <class Check>
void for_all_steps(Check check) {
  for (unsigned state = 0; state < 5; ++state) {
    for (unsigned fault = 0; fault < core::fault_names.size(); ++fault) {
      for (unsigned cause = 0; cause < core::fault_names.size(); ++cause) {
        for (unsigned bits = 0; bits < 1U << 7U; ++bits) {
          for (const auto self_test :
               {core::SelfTest::running, core::SelfTest::passed, core::SelfTest::failed}) {
            const auto bit = [&](unsigned i) { return (bits >> i & 1U) != 0; };
            const core::Supervisor now = {.state = static_cast<State>(state),
                                          .fault = static_cast<Fault>(fault),
                                          .faults = core::set_if(fault != 0, static_cast<Fault>(fault))};
            check(now, core::Conditions{.self_test = self_test,
                                        .granted = {.arm = bit(0), .disarm = bit(1), .clear = bit(2)},
                                        .emergency_stop = bit(3),
                                        .causes = core::set_if(cause != 0, static_cast<Fault>(cause)),
                                        .vision_fresh = bit(4),
                                        .vision_ready = bit(5),
                                        .wheels_fresh = bit(6)});
          }
        }
      }
    }
  }
}

bool is_tested(State state) {
  return state == State::standby || state == State::active;
}

// So a step that ran a part of the self-test began outside both, and does not end in active: it decides nothing.
TEST(StepFacts, ASelfTestIsNeverActive) {
  for_all_steps([](const core::Supervisor& now, const core::Conditions& conditions) {
    const State next = supervise(now, conditions).state;
    if (is_tested(next) && !is_tested(now.state)) {
      ASSERT_EQ(conditions.self_test, core::SelfTest::passed);
    }
    if (next == State::active) {
      ASSERT_TRUE(is_tested(now.state));
    }
  });
}

TEST(StepFacts, CorruptStateDecidesNothing) {
  for_all_steps([](core::Supervisor now, const core::Conditions& conditions) {
    now.state = State::fault;
    now.faults |= core::set_of(Fault::state_corrupt);
    ASSERT_EQ(supervise(now, conditions).state, State::fault);
  });
}

TEST(StepFacts, ALatchedFaultDecidesNothing) {
  for_all_steps([](const core::Supervisor& now, const core::Conditions& conditions) {
    ASSERT_EQ(core::latch(now, core::set_of(Fault::overrun)).state, State::fault);
    if (conditions.causes != 0) {
      ASSERT_EQ(supervise(now, conditions).state, State::fault);
    }
  });
}

TEST(StepFacts, ADisarmDecidesNothing) {
  for_all_steps([](const core::Supervisor& now, core::Conditions conditions) {
    conditions.granted.disarm = true;
    ASSERT_NE(supervise(now, conditions).state, State::active);
  });
}

// The other half of ALatchedFaultDecidesNothing: after a decision nothing is latched, as the check lets the loops' wish
// pass. At rest, wound up either way, and at every speed that a frame can tell.
TEST(StepFacts, TheLoopsOwnWishIsNeverRefused) {
  const core::RobotProfile& robot = loop::built_in_robot;
  for (std::int32_t set_point = -robot.top_rim_speed_mm_s; set_point <= robot.top_rim_speed_mm_s;
       set_point += 170) {
    for (const std::int32_t wound_at : {set_point, set_point - 100, set_point + 100}) {
      core::PendingTorques pending;
      core::WheelLoops wound;
      for (int tick = 0; tick < 200; ++tick) {
        (void)wound.step(robot, {set_point, set_point}, {wound_at, wound_at}, pending);
      }
      for (std::int32_t speed = -8000; speed <= 8000; ++speed) {
        core::WheelLoops loops = wound;
        const core::WheelSpeeds measured = {speed, speed};
        (void)loops.see(robot, measured);
        const core::DriveCommand wanted = {
            .torque = loops.step(robot, {set_point, set_point}, measured, pending),
            .set_point = {set_point, set_point}};
        ASSERT_EQ(check_command(robot, wanted, {true, true, true, measured}), Fault::none)
            << set_point << " " << speed;
      }
    }
  }
}

// In every phase up to four periods after the last decision, whatever came between.
TEST(StepFacts, ANewPictureIsDecidedOn) {
  for (unsigned bits = 0; bits < 1U << 3U; ++bits) {
    for (std::uint32_t first = 0; first <= 4 * core::decision_period_ticks; ++first) {
      for (std::uint32_t phase = 0; phase <= 4 * core::decision_period_ticks; ++phase) {
        const bool on_each_picture = (bits & 1U) != 0;
        core::DecisionClock clock;
        if ((bits & 2U) != 0) {
          clock.make_due(0);
        }
        (void)clock.at(first, (bits & 4U) != 0, on_each_picture);
        const core::DecisionDue due = clock.at(first + phase, true, on_each_picture);
        ASSERT_NE(due, core::DecisionDue::extrapolated);
        ASSERT_NE(due, core::DecisionDue::provisional);
      }
    }
  }
}

// The gate cuts to its limits; a checked command is within them, and so was the one before.
TEST(StepFacts, TheGateNeverCutsAControllersCommand) {
  const core::RobotProfile& robot = loop::built_in_robot;
  const safety::GateLimits limits = loop::gate_limits_of(robot);
  EXPECT_EQ(limits.torque_mNm, robot.torque_limit_mNm);
  EXPECT_GE(limits.slew_mNm, 2 * robot.torque_limit_mNm);
  EXPECT_GE(limits.set_point_mm_s, robot.top_rim_speed_mm_s);
  const core::DriveCommand beyond = {.torque = {robot.torque_limit_mNm + 1, 0}, .set_point = {}};
  EXPECT_NE(check_command(robot, beyond, {true, true, true, {}}), Fault::none);
}

// Whatever is due.
TEST(StepFacts, SendsOneOfEach) {
  static_assert(can::Reporter::most_frames == 8 && can::StrikerDrives::sends.size() == 1);
  for (unsigned bits = 0; bits < 1U << 6U; ++bits) {
    const auto bit = [&](unsigned i) { return (bits >> i & 1U) != 0; };
    core::Actions actions;
    actions.state = bit(0) ? State::fault : State::active;
    actions.fault = bit(1) ? Fault::overrun : Fault::none;
    actions.faults = bit(2) ? core::set_of(Fault::overrun) : 0;
    actions.challenge = {bit(3) ? core::Order::arm : core::Order::none, 1};
    if (bit(4)) {
      actions.decision = core::Decision{};
    }
    can::Reporter reporter;
    can::FrameList frames;
    can::StrikerDrives drives;
    can::PortReport port;
    port.repeat_fault = bit(5);
    reporter.report(1000, actions, {}, port, 0, frames);
    drives.put({}, frames);
    std::map<std::uint32_t, int> sent;
    for (const can::Frame& frame : frames.frames()) {
      EXPECT_EQ(++sent[frame.id], 1);
    }
    const int faults = sent[can::layout<can::FaultReport>.info.id];
    EXPECT_LE(frames.frames().size(), 8U + static_cast<std::size_t>(faults));
    EXPECT_TRUE(faults == 0 || actions.state == State::fault);
  }
}

TEST(StepFacts, ConsentHasSixBytes) {
  static_assert(can::layout<can::ModeCommand>.info.length == 6 &&
                can::layout<can::Challenge>.info.length == 6);
}

// As a pilot that never decided: what came before is not in the inputs.
TEST(StepFacts, ArmingShiftsNoHistory) {
  loop::BuiltInPilot used;
  core::RelativeState seen;
  for (int i = 0; i < 5; ++i) {
    seen.ball_um = {1000 * i, 77 * i};
    (void)used.decide(seen, core::DecisionDue::on_picture);
  }
  used.reset();
  loop::BuiltInPilot fresh;
  (void)used.decide(seen, core::DecisionDue::on_picture);
  (void)fresh.decide(seen, core::DecisionDue::on_picture);
  EXPECT_EQ(used.inputs(), fresh.inputs());
}

TEST(StepFacts, TheDelayStandsBehindEightWords) {
  static_assert(offsetof(core::RobotProfile, command_delay_ticks) == 32);
  core::RobotProfile robot = loop::built_in_robot;
  robot.command_delay_ticks = 37;
  const core::Controller<loop::BuiltInPilot> controller(robot);
  std::int32_t word = 0;
  std::memcpy(&word, reinterpret_cast<const unsigned char*>(&controller) + 32, sizeof word);
  EXPECT_EQ(word, 37);
}

}  // namespace
}  // namespace striker
