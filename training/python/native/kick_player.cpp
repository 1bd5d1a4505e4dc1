// SPDX-License-Identifier: Apache-2.0
#include "training/python/native/kick_player.hpp"

namespace striker::training {

KickPlayer::KickPlayer(const std::vector<TaskConfig>& tasks) {
  for (const TaskConfig& task : tasks) {
    environments_.emplace_back(task);
  }
  actions_.reserve(sil::kick_decisions);
}

void KickPlayer::reset(std::uint64_t seed, std::uint64_t episode) {
  seed_ = seed;
  episode_ = episode;
  current_ = episode % environments_.size();
  environments_[current_].reset(seed, episode);
  is_playing_ = true;
  last_ = {};
  actions_.clear();
}

StepResult KickPlayer::step(int action) {
  last_ = environments_[current_].step(action);
  actions_.push_back(static_cast<std::uint8_t>(action));
  is_playing_ = !last_.end;
  return last_;
}

Record KickPlayer::record() const {
  const KickEnvironment& env = now();
  const sil::KickOutcome& outcome = env.outcome();
  const RcsState& state = env.state();
  const auto flag = [](bool value) { return value ? 1.0 : 0.0; };
  return {static_cast<double>(actions_.size()),
          actions_.empty() ? 0.0 : actions_.back(),
          last_.reward,
          flag(outcome.contact),
          flag(last_.success),
          outcome.theta_contact_rad,
          outcome.v_contact_m_s,
          flag(outcome.front_face),
          state.ball_x_m,
          state.ball_y_m,
          state.robot_speed_m_s,
          state.ball_vx_m_s,
          state.ball_vy_m_s,
          state.ball_angle_rad,
          static_cast<double>(env.decisions_left()),
          flag(last_.end && !last_.truncated),
          flag(last_.truncated)};
}

}  // namespace striker::training
