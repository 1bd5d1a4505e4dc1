// SPDX-License-Identifier: Apache-2.0
// One kick episode after another, as a learner meets them (environment.hpp). The servo plant of the paper:
// wheels that hold a set-point within a torque ceiling. Delays of the task's robot are played, and led through in what
// the learner sees (described_delays.hpp). The decision of an aimed contact lasts until
// the ball is measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>

#include "sil/task/kick_task.hpp"
#include "sil/world/planar_world.hpp"
#include "sil/world/random.hpp"
#include "sil/world/world.hpp"
#include "training/task/described_delays.hpp"
#include "training/task/environment.hpp"
#include "training/task/physics_step.hpp"
#include "training/task/recent.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

class KickEnvironment {
 public:
  using Outcome = sil::KickOutcome;

  explicit KickEnvironment(const TaskConfig& task);

  void reset(std::uint64_t seed, std::uint64_t episode);
  StepResult step(int action);  // up to 40 times after a reset
  // 100 ms with set-point 0, unless the kick is measured: so that a late one is, too.
  void finish();

  [[nodiscard]] const TaskConfig& config() const { return config_; }
  [[nodiscard]] const Features& features() const { return features_; }
  [[nodiscard]] const RcsState& state() const { return history_.ago(0).rcs; }
  [[nodiscard]] const Observation& seen() const {
    return history_.ago(0).field;
  }  // what `state` is computed from
  [[nodiscard]] int decisions_left() const { return sil::kick_decisions - decisions_; }
  [[nodiscard]] RawState raw() const { return raw_state(config_.inputs, history_, in_mirror()); }
  [[nodiscard]] const Outcome& outcome() const { return episode_.outcome(); }
  [[nodiscard]] bool success() const { return outcome().contact; }
  [[nodiscard]] bool settled() const { return decisions_ == sil::kick_decisions || outcome().ball_measured; }
  [[nodiscard]] double simulated_s() const { return simulated_s_; }  // since it was made

 private:
  [[nodiscard]] bool in_mirror() const { return config_.one_sided && state().ball_y_m < 0.0; }
  void drive(const SetPoint& set_point, int steps);
  void turn_wheels(const SetPoint& set_point);
  [[nodiscard]] const sil::BallState& ball_before(int steps) const {
    return balls_.ago(static_cast<std::size_t>(steps));
  }
  void lead(Observation& seen) const;
  void drive_until_measured(const SetPoint& set_point);
  [[nodiscard]] DecisionState observed() const;

  // As old as a picture may be, and the one before it.
  static constexpr std::size_t balls_kept = 2 * steps_per_decision + 1;

  TaskConfig config_;
  std::variant<sil::PlanarWorld, sil::World> world_;
  sil::PlanarModel model_;  // of the robot, as described
  double torque_limit_Nm_;  // of each wheel
  DescribedDelays delays_;
  sil::KickEpisode episode_;
  SetPoint set_point_;  // the last decision's
  // Now, a physics step ago, ...
  Recent<sil::BallState, balls_kept> balls_;
  History history_;
  sil::Random dummies_;
  Features features_;
  int decisions_ = 0;
  double simulated_s_ = 0.0;
};

static_assert(Environment<KickEnvironment>);

}  // namespace striker::training
