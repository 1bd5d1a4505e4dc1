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
    link_.send(tick, passed);
  }
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override { link_.collect(tick, answer); }

  std::function<bool(const can::Frame&)> drops;
  std::optional<can::Frame> adds;

 private:
  NodeLink<loop::OrderedNode> link_{core::profile_of(core::defender)};
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
  MeddledLink link_;
  MatchRobot robot_;
  std::uint32_t tick_ = 0;
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
