// SPDX-License-Identifier: Apache-2.0
// The operator of a robot in a match, with a real controller at the other end of the bus.
#include "sil/match/play/robot_operator.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

#include "firmware/can/messages.hpp"
#include "sil/bus/in_process_link.hpp"
#include "sil/match/play/match_robot.hpp"

namespace striker::sil {
namespace {

// A bus on which somebody may take frames away, or say something too.
class MeddledLink final : public ControllerLink {
 public:
  explicit MeddledLink(ControllerLink& link) : link_(&link) {}
  void send(std::uint32_t tick, std::span<const can::Frame> frames) override {
    std::vector<can::Frame> passed;
    for (const can::Frame& frame : frames) {
      if (!drops || !drops(frame)) {
        passed.push_back(frame);
      }
    }
    if (adds) {
      passed.insert(passed.begin(), *adds);
    }
    link_->send(tick, passed);
  }
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override { link_->collect(tick, answer); }

  std::function<bool(const can::Frame&)> drops;
  std::optional<can::Frame> adds;

 private:
  ControllerLink* link_;
};

class RobotOperated : public ::testing::Test {
 protected:
  RobotOperated()
      : world_({.robots = {robot_spec(Role::defender)}}),
        robot_(0, core::defender, make_plant(PlantKind::servo, 0, robot_spec(Role::defender)), link_) {}

  core::State state() const { return robot_.heard().controller_state(); }

  void place() {
    world_.place_robot(0, {});
    robot_.was_placed();
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      if (shows_pictures && tick_ % 50 == 0) {
        robot_.sees(world_, tick_);
        robot_.is_told(order, tick_);
      }
      robot_.begin_tick(tick_);
      robot_.end_tick(tick_);
      if (tick_ % 10 == 0) {
        robot_.actuate(world_, tick_);
        world_.step();
        robot_.sense(world_);
      }
      ++tick_;
    }
  }
  // The first tick from now on after which the controller is armed; at most a second.
  int ticks_until_armed() {
    for (int ticks = 1; ticks <= 1'000; ++ticks) {
      run(1);
      if (state() == core::State::active) {
        return ticks;
      }
    }
    return -1;
  }

  World world_;
  NodeLink<loop::OrderedNode> controller_{core::profile_of(core::defender)};
  MeddledLink link_{controller_};
  MatchRobot robot_;
  std::uint32_t tick_ = 0;
  std::uint32_t run_ticks_ = 0;
  bool shows_pictures = true;
  SpeedOrder order = {0.3, 0.3};
};

TEST_F(RobotOperated, IsArmedAfterTwoPicturesOfItsPlace) {
  run(500);
  EXPECT_EQ(state(), core::State::standby) << "nobody wanted it armed";
  place();
  robot_.is_wanted(true);
  const int ticks = ticks_until_armed();
  EXPECT_GE(ticks, 51);
  EXPECT_LE(ticks, 60);
}

TEST_F(RobotOperated, DrivesAsOrderedFromItsFirstTickOn) {
  place();
  robot_.is_wanted(true);
  run(1'000);
  EXPECT_NEAR(robot_.take_record(world_, tick_).rim_speeds_m_s[0], 0.3, 0.01);
  EXPECT_NEAR(robot_.take_record(world_, tick_).set_points_m_s[1], 0.3, 0.001);
}

TEST_F(RobotOperated, IsDisarmedInTheSameTick) {
  place();
  robot_.is_wanted(true);
  run(1'000);
  robot_.is_wanted(false);
  run(1);
  EXPECT_EQ(state(), core::State::standby);
}

TEST_F(RobotOperated, ADisarmThatWasLostIsGivenAgain) {
  place();
  robot_.is_wanted(true);
  run(1'000);
  robot_.is_wanted(false);
  link_.drops = [](const can::Frame& frame) { return can::is<can::ModeCommand>(frame); };
  run(10);
  link_.drops = {};
  EXPECT_EQ(state(), core::State::active);
  run(51);
  EXPECT_EQ(state(), core::State::standby);
}

TEST_F(RobotOperated, AFaultIsClearedWhenItsCauseIsOver) {
  place();
  robot_.is_wanted(true);
  run(1'000);
  shows_pictures = false;
  run(200);
  EXPECT_EQ(robot_.heard().controller_fault(), core::Fault::vision_lost);
  shows_pictures = true;
  EXPECT_GT(ticks_until_armed(), 0);
}

TEST_F(RobotOperated, AnEmergencyStopIsNot) {
  place();
  robot_.is_wanted(true);
  run(1'000);
  can::SendCounter counter;
  link_.adds = can::send(can::EmergencyStop{}, counter);
  run(1);
  link_.adds = {};
  EXPECT_EQ(ticks_until_armed(), -1);
  EXPECT_TRUE(robot_.heard().controller_is_stopped());
}

// The forward knows a kick that it would play by itself.
TEST_F(RobotOperated, AForwardWhoseTeamIsNotHeardDoesNotMove) {
  NodeLink<loop::BuiltInNode> controller{core::profile_of(core::forward)};
  MeddledLink link(controller);
  World world({.robots = {robot_spec(Role::forward)}});
  MatchRobot forward(0, core::forward, make_plant(PlantKind::servo, 0, robot_spec(Role::forward)), link);
  const auto is_order = [](const can::Frame& frame) {
    return can::is<can::WheelOrder>(frame) || can::is<can::MotionOrder>(frame);
  };
  for (const bool heard_before : {false, true}) {
    link.drops = is_order;
    for (std::uint32_t tick = 0; tick < 6'000; ++tick) {
      if (tick == 0 || tick == 3'000) {
        world.place_robot(0, {});
        forward.was_placed();
        forward.is_wanted(true);
      }
      if (tick % 50 == 0) {
        forward.sees(world, run_ticks_ + tick);
        forward.is_told(SpeedOrder{}, run_ticks_ + tick);
      }
      forward.begin_tick(run_ticks_ + tick);
      forward.end_tick(run_ticks_ + tick);
      if (tick % 10 == 0) {
        forward.actuate(world, run_ticks_ + tick);
        world.step();
        forward.sense(world);
      }
      ASSERT_NEAR(world.robot_pose(0).x_m, 0.0, 0.01)
          << "tick " << tick << ", heard before: " << heard_before;
      if (heard_before && tick < 2'000) {
        link.drops = {};
      } else {
        link.drops = is_order;
      }
    }
    run_ticks_ += 6'000;
  }
}

TEST_F(RobotOperated, ARunOfMinutesIsRenewed) {
  place();
  robot_.is_wanted(true);
  order = {};
  run(1'000);
  for (int second = 0; second < 25; ++second) {
    run(1'000);
    ASSERT_EQ(state(), core::State::active) << "after " << second << " s";
  }
}

}  // namespace
}  // namespace striker::sil
