// SPDX-License-Identifier: Apache-2.0
// How an episode's robot, ball, camera and commands differ from the nominal ones: domain randomisation (Tobin et al.
// 2017). What they do is in line_episode.cpp; who draws them and how often is said by [randomise].
#pragma once

#include "sil/world/planar_robot.hpp"
#include "sil/world/random.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

// Scales are factors of the nominal value. The default is the nominal robot.
struct Conditions {
  double mass_scale = 1.0;
  double torque_scale = 1.0;
  double friction_scale = 1.0;      // of the tyres: limits the force, as the torque does
  double ball_damping_scale = 1.0;  // of the rate at which the ball slows down
  int command_delay_steps = 0;      // physics steps of 10 ms until a decision acts, at most a decision's
  double vision_noise_m = 0.0;      // standard deviation of each coordinate of ball and robot
  int vision_late_frames = 0;       // 0 or 1, of 50 ms
  bool operator==(const Conditions&) const = default;
};

// The ranges shrunk towards the nominal values by `strength`, 0 to 1.
[[nodiscard]] Conditions draw_conditions(const RandomiseConfig& ranges, double strength, sil::Random& random);

// What meets in a contact.
struct Bodies {
  sil::PlanarModel robot;
  double torque_ceiling_Nm = 0.0;  // of each wheel
  double ball_kept_after_1_s = sil::kept_after_1_s;
  bool operator==(const Bodies&) const = default;
};

[[nodiscard]] Bodies bodies_of(const core::RobotDescription& robot, const Conditions& conditions = {});

// The greatest gain of this robot's speed in a physics step, straight on.
[[nodiscard]] double gain_limit_m_s(const core::RobotDescription& robot, const Conditions& conditions);

// The share of its velocity that the ball keeps in a physics step.
[[nodiscard]] double ball_kept(const Conditions& conditions);

}  // namespace striker::training
