// SPDX-License-Identifier: Apache-2.0
// One world of the kick as Python plays it: which episode it is in, what was done in it, and how it stands.
//
//   KickPlayer player(tasks);        // several tasks, equal but for their velocities, are played in turn
//   player.reset(seed, episode);     // the episode of that number that striker-evaluate plays
//   while (!player.step(action).end) ...
//
// The actions since the last reset are kept, so that a copy in another process can be brought to the same state: an
// episode is a pure function of (seed, episode) and of them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "training/task/kick_environment.hpp"

namespace striker::training {

// What a decision was, and what a reward may be computed from. Places and speeds are what the learner sees: estimated
// where the task says so, in the robot's frame, SI units. The rest is the truth.
inline constexpr std::array<std::string_view, 17> record_fields = {
    "decision",      // 1 to 40: how many were taken, this one included
    "action",        // this decision's
    "reward",        // what the task pays for it
    "contact",       // 1: the robot has touched the ball in this episode
    "just_contact",  // 1: for the first time, in this decision
    "theta_contact_rad",
    "v_contact_m_s",
    "front_face",  // of the first contact; 0 without one
    "ball_x_m",
    "ball_y_m",
    "robot_speed_m_s",
    "ball_vx_m_s",
    "ball_vy_m_s",
    "ball_angle_rad",
    "decisions_left",  // 39 to 0
    "terminated",
    "truncated"};

using Record = std::array<double, record_fields.size()>;

class KickPlayer {
 public:
  // The tasks are not empty; their inputs and actions are as many.
  explicit KickPlayer(const std::vector<TaskConfig>& tasks);

  void reset(std::uint64_t seed, std::uint64_t episode);
  // `action` is one of the task's. To be called after a reset, until the end.
  StepResult step(int action);

  // Between a reset and the end that follows.
  [[nodiscard]] bool is_playing() const { return is_playing_; }
  [[nodiscard]] const KickEnvironment& now() const { return environments_[current_]; }
  [[nodiscard]] Record record() const;

  [[nodiscard]] std::uint64_t seed() const { return seed_; }
  [[nodiscard]] std::uint64_t episode() const { return episode_; }
  [[nodiscard]] const std::vector<std::uint8_t>& actions() const { return actions_; }

 private:
  std::vector<KickEnvironment> environments_;
  std::size_t current_ = 0;
  std::uint64_t seed_ = 0;
  std::uint64_t episode_ = 0;
  bool is_playing_ = false;
  StepResult last_;
  std::vector<std::uint8_t> actions_;
};

}  // namespace striker::training
