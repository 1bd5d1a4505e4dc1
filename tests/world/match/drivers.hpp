// SPDX-License-Identifier: Apache-2.0
// Who drives ten robots in these tests: at random, or all into one corner.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/world/play.hpp"

namespace striker::sil {

// Every 50 ms some robots change their mind: after the ball, backwards, or any two wheel speeds.
class RandomDrivers {
 public:
  RandomDrivers(World& world, const WorldConfig& config, std::uint64_t seed)
      : world_(world), config_(config), random_(seed, 0, 0), minds_(config.robots.size()) {
    for (std::size_t i = 0; i < minds_.size(); ++i) {
      world_.place_robot(i, {.x_m = -2.0 + 0.45 * static_cast<double>(i),
                             .y_m = 0.3 * static_cast<double>(i % 3),
                             .heading_rad = 0.5 * static_cast<double>(i)});
    }
    world_.place_ball({.position_m = {random_.uniform(-1.0, 1.0), 1.0}, .velocity_m_s = {1.0, 1.0}});
  }

  void step() {
    const auto steps = std::lround(0.050 / config_.step_s);
    if (steps_++ % steps == 0) {
      for (std::size_t i = 0; i < minds_.size(); ++i) {
        steer(i);
      }
    }
    world_.step();
  }

 private:
  struct Mind {
    bool chases = true;
    double left = 0.0;  // shares of the largest speed
    double right = 0.0;
  };

  void steer(std::size_t i) {
    Mind& mind = minds_[i];
    if (random_.uniform(0.0, 1.0) < 0.05) {
      mind = {.chases = random_.uniform(0.0, 1.0) < 0.4,
              .left = random_.uniform(-1.0, 1.0),
              .right = random_.uniform(-1.0, 1.0)};
    }
    const double top_m_s = config_.robots[i].max_rim_speed_m_s;
    if (mind.chases) {
      const Pose pose = world_.robot_pose(i);
      const Vec2 ball = world_.ball().position_m;
      const double aside_rad = std::remainder(
          std::atan2(ball.y - pose.y_m, ball.x - pose.x_m) - pose.heading_rad, 2.0 * std::numbers::pi);
      mind.left = std::clamp((std::abs(aside_rad) < 1.0 ? 1.0 : 0.2) - 0.3 * aside_rad, -1.0, 1.0);
      mind.right = std::clamp((std::abs(aside_rad) < 1.0 ? 1.0 : 0.2) + 0.3 * aside_rad, -1.0, 1.0);
    }
    drive(world_, i, top_m_s * mind.left, top_m_s * mind.right, config_.robots[i].max_wheel_torque_Nm);
  }

  World& world_;
  const WorldConfig& config_;
  Random random_;
  std::vector<Mind> minds_;
  long steps_ = 0;
};

// Ten robots in front of one corner, the ball in it.
inline void place_for_corner(World& world) {
  for (std::size_t i = 0; i < 10; ++i) {
    const double column = static_cast<double>(i % 4);
    const std::size_t row = i / 4;
    world.place_robot(
        i, {.x_m = 3.0 + 0.2 * column, .y_m = 1.3 + 0.25 * static_cast<double>(row), .heading_rad = 0.8});
  }
  world.place_ball({.position_m = {3.7, 2.1}, .velocity_m_s = {}});
}

// All of them into it, or back out.
inline void press(World& world, const WorldConfig& config, double speed_m_s, double seconds) {
  for (long step = 0; step < std::lround(seconds / config.step_s); ++step) {
    for (std::size_t i = 0; i < config.robots.size(); ++i) {
      const Pose pose = world.robot_pose(i);
      const double aside_rad = std::remainder(std::atan2(2.6 - pose.y_m, 4.2 - pose.x_m) - pose.heading_rad,
                                              2.0 * std::numbers::pi);
      drive(world, i, speed_m_s - 0.5 * aside_rad, speed_m_s + 0.5 * aside_rad,
            config.robots[i].max_wheel_torque_Nm);
    }
    world.step();
  }
}

}  // namespace striker::sil
