// SPDX-License-Identifier: Apache-2.0
// What a configuration says about the task: which environment plays it, where, with which inputs and actions.
#pragma once

#include <string>
#include <vector>

#include "firmware/core/robot_profile.hpp"
#include "sil/task/kick_task.hpp"
#include "training/task/state.hpp"

namespace striker::training {

// Which environment plays the task (environments.hpp). `task.kind` in TOML: "kick" and "aimed" are both a kick's, with
// another reward (sil::KickReward).
enum class TaskKind { kick };

// Both are the paper's servo plant. `planar`: the robot as one body on the plane (sil::PlanarWorld), 200
// times as fast; `full`: wheel bodies in ODE (sil::World), the reference. They are "fast" and "full" to a
// user.
enum class Physics { planar, full };

// `exact`: the world's own velocities. `estimated`: as the firmware has them, the ball's from the last two
// vision frames (50 ms apart, exact positions), the robot's from its wheels.
enum class Velocities { exact, estimated };

// An action: the rim speeds that the wheels are set to.
struct SetPoint {
  double left_m_s = 0.0;
  double right_m_s = 0.0;
  bool operator==(const SetPoint&) const = default;
};

// The same action seen in a mirror along the heading: the wheels change places.
[[nodiscard]] constexpr SetPoint mirrored(const SetPoint& action) {
  return {.left_m_s = action.right_m_s, .right_m_s = action.left_m_s};
}

// Forward, stop, backward, as fast as the robot's wheels go (paper, section IV.A).
[[nodiscard]] std::vector<SetPoint> kick_actions(const core::RobotDescription& robot = core::forward);

// The number of the action that is the mirror image of this one; -1 if none is.
[[nodiscard]] int mirrored_action(const std::vector<SetPoint>& actions, int action);

struct Range {
  double low = 0.0;
  double high = 0.0;
};

// What a learner from own rollouts practises on beside the nominal robot; [randomise] in TOML. Fractions are of the
// nominal value: mass -0.3 is 30 % less.
struct RandomiseConfig {
  double share = 0.0;     // of the episodes; the others are nominal
  int ramp_episodes = 0;  // the ranges grow from nothing to all of themselves in so many
  Range mass, torque, friction, ball_damping;
  Range command_delay_ms, vision_noise_mm, vision_late_ms;
};

struct TaskConfig {
  TaskKind kind = TaskKind::kick;
  // Whose servos, mass and tyres the worlds have, the paper's forward. Its delays play no part in training: the
  // controller foresees them.
  core::RobotDescription robot = core::forward;
  Physics physics = Physics::planar;
  sil::PoseMode pose = sil::PoseMode::origin;
  Velocities velocities = Velocities::exact;
  Equations equations = Equations::corrected;
  StateInputs inputs = rcs_inputs();
  // The network sees the ball on the left only: where it is on the right, the situation is seen as in a
  // mirror along the heading, and an action swaps the wheels. `task.mirrored` in TOML, `mirrored` in an
  // exported header.
  bool one_sided = false;
  std::vector<SetPoint> actions = kick_actions(robot);
  // What a kick pays, and whether the learner's episode goes on after the contact.
  sil::KickRules rules = {};
  bool goes_on = false;
  RandomiseConfig randomise = {};
};

// Which action's set-point the robot's wheels do not reach, as "task.actions[NUMBER] = ...: WHY"; empty if they reach
// all.
[[nodiscard]] std::string unreachable_action(const TaskConfig& task);

}  // namespace striker::training
