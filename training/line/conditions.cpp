// SPDX-License-Identifier: Apache-2.0
#include "training/line/conditions.hpp"

#include <algorithm>
#include <cmath>

#include "training/line/line_play.hpp"

namespace striker::training {

namespace {

double drawn(const Range& range, double strength, sil::Random& random) {
  return strength * random.uniform(range.low, range.high);
}

// Of 0 to `range.high` in whole units, each as likely.
int drawn_whole(const Range& range, double unit, double strength, sil::Random& random) {
  const double low = std::round(range.low / unit);
  const double high = std::round(range.high / unit);
  const double count = high - low + 1.0;
  const double value = low + std::min(std::floor(count * random.uniform()), high - low);
  return static_cast<int>(std::lround(strength * value));
}

constexpr double frame_ms = sil::decision_period_ms;

}  // namespace

Conditions draw_conditions(const RandomiseConfig& ranges, double strength, sil::Random& random) {
  Conditions conditions;
  conditions.mass_scale = 1.0 + drawn(ranges.mass, strength, random);
  conditions.torque_scale = 1.0 + drawn(ranges.torque, strength, random);
  conditions.friction_scale = 1.0 + drawn(ranges.friction, strength, random);
  conditions.ball_damping_scale = 1.0 + drawn(ranges.ball_damping, strength, random);
  conditions.command_delay_steps = drawn_whole(ranges.command_delay_ms, physics_step_ms, strength, random);
  conditions.vision_noise_m = 0.001 * drawn(ranges.vision_noise_mm, strength, random);
  conditions.vision_late_frames = drawn_whole(ranges.vision_late_ms, frame_ms, strength, random);
  return conditions;
}

Bodies bodies_of(const core::RobotDescription& robot, const Conditions& conditions) {
  const sil::RobotSpec spec = sil::spec_of(robot);
  sil::PlanarModel model = sil::planar_model(spec);
  model.grip_N = conditions.friction_scale * conditions.mass_scale * model.grip_N;
  for (double* const inert :
       {&model.mass_kg, &model.own_inertia_kgm2, &model.wheel_inertia_kgm2, &model.inertia_kgm2}) {
    *inert = conditions.mass_scale * *inert;
  }
  return {.robot = model,
          .torque_ceiling_Nm = conditions.torque_scale * spec.max_wheel_torque_Nm,
          .ball_kept_after_1_s = conditions.ball_damping_scale == 1.0
                                     ? sil::kept_after_1_s
                                     : std::exp(-conditions.ball_damping_scale * sil::damping_per_s)};
}

double gain_limit_m_s(const core::RobotDescription& robot, const Conditions& conditions) {
  const Bodies bodies = bodies_of(robot, conditions);
  return sil::straight_gain_limit_m_s(bodies.robot, {.torque_ceiling_Nm = bodies.torque_ceiling_Nm},
                                      physics_step_s);
}

double ball_kept(const Conditions& conditions) {
  // The logarithm's rounding must not move the nominal ball.
  return conditions.ball_damping_scale == 1.0
             ? sil::kept_in_10_ms
             : std::exp(-conditions.ball_damping_scale * sil::damping_per_s * physics_step_s);
}

}  // namespace striker::training
