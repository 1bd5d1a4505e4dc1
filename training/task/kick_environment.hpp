// SPDX-License-Identifier: Apache-2.0
// One kick episode after another, as a learner meets them (environment.hpp). The servo plant of the paper:
// wheels that hold a set-point within a torque ceiling, physics steps of 10 ms, five a decision. The decision of an
// aimed contact lasts until the ball is measured.
#pragma once

#include <cstdint>
#include <variant>

#include "sil/task/kick_task.hpp"
#include "sil/world/planar_world.hpp"
#include "sil/world/random.hpp"
#include "sil/world/world.hpp"
#include "training/task/environment.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

inline constexpr int physics_step_ms = 10;
inline constexpr double physics_step_s = physics_step_ms / 1000.0;
inline constexpr int steps_per_decision = sil::decision_period_ms / physics_step_ms;
static_assert(steps_per_decision * physics_step_ms == sil::decision_period_ms);

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
  [[nodiscard]] int decisions_left() const { return history_.ago(0).decisions_left; }
  [[nodiscard]] RawState raw() const { return raw_state(config_.inputs, history_, in_mirror()); }
  [[nodiscard]] const Outcome& outcome() const { return episode_.outcome(); }
  [[nodiscard]] bool success() const { return outcome().contact; }
  [[nodiscard]] bool settled() const { return decisions_ == sil::kick_decisions || outcome().ball_measured; }
  [[nodiscard]] double simulated_s() const { return simulated_s_; }  // since it was made

 private:
  [[nodiscard]] bool in_mirror() const { return config_.one_sided && state().ball_y_m < 0.0; }
  void drive(const SetPoint& set_point, int steps);
  void drive_until_measured(const SetPoint& set_point);
  [[nodiscard]] DecisionState observed() const;

  TaskConfig config_;
  std::variant<sil::PlanarWorld, sil::World> world_;
  double torque_limit_Nm_;  // of each wheel
  sil::KickEpisode episode_;
  sil::Vec2 last_ball_m_;  // one vision frame ago
  History history_;
  sil::Random dummies_;
  Features features_;
  int decisions_ = 0;
  double simulated_s_ = 0.0;
};

static_assert(Environment<KickEnvironment>);

}  // namespace striker::training
