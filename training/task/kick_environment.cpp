// SPDX-License-Identifier: Apache-2.0
#include "training/task/kick_environment.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/policy/policy.hpp"
#include "sil/world/random_streams.hpp"

namespace striker::training {

namespace {

static_assert(sil::kick_decisions == policy::decisions_a_kick, "the firmware counts other decisions down");

std::variant<sil::PlanarWorld, sil::World> make_world(const TaskConfig& task) {
  const sil::WorldConfig world = sil::kick_world(physics_step_s, {.robot = sil::spec_of(task.robot)});
  if (task.physics == Physics::planar) {
    return sil::PlanarWorld(world);
  }
  return sil::World(world);
}

}  // namespace

KickEnvironment::KickEnvironment(const TaskConfig& task)
    : config_(task),
      world_(make_world(task)),
      model_(sil::planar_model(sil::spec_of(task.robot))),
      torque_limit_Nm_(sil::spec_of(task.robot).max_wheel_torque_Nm),
      delays_(described_delays(task.robot)),
      episode_(task.rules),
      dummies_(0, 0, sil::random_stream::dummies),
      features_(task.inputs.size()) {}

void KickEnvironment::reset(std::uint64_t seed, std::uint64_t episode) {
  const sil::KickStart start = sil::draw_kick(seed, episode, config_.pose, config_.rules);
  for (std::size_t steps = balls_kept - 1; steps > 0; --steps) {
    balls_.add(sil::ball_before(start, static_cast<double>(steps) * physics_step_s));
  }
  std::visit(
      [&](auto& world) {
        episode_.begin(world, start);
        balls_.add(world.ball());
      },
      world_);
  set_point_ = {};
  dummies_ = sil::Random(seed, episode, sil::random_stream::dummies);
  decisions_ = 0;
  history_.begin(observed());
  write_features(config_.inputs, history_, in_mirror(), dummies_, features_);
}

StepResult KickEnvironment::step(int action) {
  const bool before = success();
  const SetPoint& set_point = config_.actions[static_cast<std::size_t>(action)];
  const SetPoint driven = in_mirror() ? mirrored(set_point) : set_point;
  drive(driven, steps_per_decision);
  if (config_.rules.reward == sil::KickReward::aimed && success() && !before) {
    drive_until_measured(driven);
  }
  StepResult result;
  result.reward = episode_.end_decision();
  ++decisions_;
  history_.add(observed());
  write_features(config_.inputs, history_, in_mirror(), dummies_, features_);
  result.success = success() && !before;
  result.last = decisions_ == sil::kick_decisions;
  const bool done = result.success && !config_.goes_on;
  result.end = result.last || done;
  result.truncated = result.last && !done;
  return result;
}

// The contact is paid for by then. Nothing that a learner reads comes after it.
void KickEnvironment::drive_until_measured(const SetPoint& set_point) {
  while (!outcome().ball_measured) {
    drive(set_point, 1);
  }
}

void KickEnvironment::finish() {
  if (!outcome().ball_measured) {
    drive({}, 2 * steps_per_decision);
  }
}

void KickEnvironment::drive(const SetPoint& set_point, int steps) {
  turn_wheels(delays_.command_steps > 0 ? set_point_ : set_point);
  for (int i = 0; i < steps; ++i) {
    if (i > 0 && i == delays_.command_steps) {
      turn_wheels(set_point);
    }
    std::visit(
        [&](auto& world) {
          episode_.step(world);
          balls_.add(world.ball());
        },
        world_);
  }
  set_point_ = set_point;
  simulated_s_ += physics_step_s * steps;
}

void KickEnvironment::turn_wheels(const SetPoint& set_point) {
  std::visit(
      [&](auto& world) {
        world.servo_wheel(0, sil::Wheel::left, set_point.left_m_s, torque_limit_Nm_);
        world.servo_wheel(0, sil::Wheel::right, set_point.right_m_s, torque_limit_Nm_);
      },
      world_);
}

// To where the next decision will begin to act.
void KickEnvironment::lead(Observation& seen) const {
  for (int i = 0; i < delays_.picture_steps + delays_.command_steps; ++i) {
    roll_on(seen.ball);
  }
  if (delays_.command_steps == 0) {
    return;
  }
  const double c = std::cos(seen.robot.heading_rad);
  const double s = std::sin(seen.robot.heading_rad);
  const sil::WheelServo both = {.rim_speed_m_s = 0.5 * (set_point_.left_m_s + set_point_.right_m_s),
                                .torque_ceiling_Nm = torque_limit_Nm_};
  for (int i = 0; i < delays_.command_steps; ++i) {
    const sil::Vec2 velocity_m_s = seen.robot_velocity_m_s;
    const double speed_m_s =
        sil::straight_speed_m_s(c * velocity_m_s.x + s * velocity_m_s.y, both, physics_step_s, model_);
    seen.robot.x_m += physics_step_s * speed_m_s * c;
    seen.robot.y_m += physics_step_s * speed_m_s * s;
    seen.robot_velocity_m_s = {sil::kept_in_10_ms * speed_m_s * c, sil::kept_in_10_ms * speed_m_s * s};
  }
}

DecisionState KickEnvironment::observed() const {
  DecisionState now;
  now.decisions_left = std::max(sil::kick_decisions - decisions_ - delays_.decisions_begun(), 0);
  std::visit(
      [&](const auto& world) {
        Observation& seen = now.field;
        seen = {.robot = world.robot_pose(0),
                .robot_velocity_m_s = world.robot_velocity_m_s(0),
                .ball = ball_before(delays_.picture_steps)};
        if (config_.velocities == Velocities::estimated) {
          const double speed_m_s =
              0.5 * (world.rim_speed_m_s(0, sil::Wheel::left) + world.rim_speed_m_s(0, sil::Wheel::right));
          seen.robot_velocity_m_s = {speed_m_s * std::cos(seen.robot.heading_rad),
                                     speed_m_s * std::sin(seen.robot.heading_rad)};
          const sil::Vec2 last_m = ball_before(delays_.picture_steps + steps_per_decision).position_m;
          seen.ball.velocity_m_s = {(seen.ball.position_m.x - last_m.x) / sil::decision_period_s,
                                    (seen.ball.position_m.y - last_m.y) / sil::decision_period_s};
        }
      },
      world_);
  lead(now.field);
  now.rcs = rcs_state(now.field, config_.equations);
  return now;
}

}  // namespace striker::training
