#include "kick_env.hpp"

#include <cmath>

namespace striker::training {

KickEnv::KickEnv(const EnvConfig& config) : config_(config), world_(sil::kick_world(physics_step_s)) {}

void KickEnv::reset(const sil::KickStart& start) {
  episode_.begin(world_, start);
  last_ball_m_ = sil::ball_before(start, sil::decision_period_s).position_m;
  decisions_ = 0;
  observe();
}

StepResult KickEnv::step(int action) {
  last_ball_m_ = world_.ball().position_m;
  const bool before = outcome().contact;
  drive(set_points_m_s.at(static_cast<std::size_t>(action)), steps_per_decision);
  const double reward = episode_.end_decision();
  ++decisions_;
  observe();
  return {
      .reward = reward, .contact = outcome().contact && !before, .last = decisions_ == sil::kick_decisions};
}

void KickEnv::coast() {
  drive(0.0, 2 * steps_per_decision);
}

void KickEnv::drive(double set_point_m_s, int steps) {
  world_.servo_wheel(0, sil::Wheel::left, set_point_m_s, torque_ceiling_Nm);
  world_.servo_wheel(0, sil::Wheel::right, set_point_m_s, torque_ceiling_Nm);
  for (int i = 0; i < steps; ++i) {
    episode_.step(world_);
    simulated_s_ += physics_step_s;
  }
}

void KickEnv::observe() {
  Observation seen{.robot = world_.robot_pose(0),
                   .robot_velocity_m_s = world_.robot_velocity_m_s(0),
                   .ball = world_.ball()};
  if (config_.velocities == Velocities::estimated) {
    const double speed_m_s =
        0.5 * (world_.rim_speed_m_s(0, sil::Wheel::left) + world_.rim_speed_m_s(0, sil::Wheel::right));
    seen.robot_velocity_m_s = {speed_m_s * std::cos(seen.robot.heading_rad),
                               speed_m_s * std::sin(seen.robot.heading_rad)};
    seen.ball.velocity_m_s = {(seen.ball.position_m.x - last_ball_m_.x) / sil::decision_period_s,
                              (seen.ball.position_m.y - last_ball_m_.y) / sil::decision_period_s};
  }
  state_ = rcs_state(seen, config_.equations);
}

sil::KickOutcome play(KickEnv& env, const sil::KickStart& start, const Choice& choose) {
  env.reset(start);
  bool last = false;
  while (!last && !env.outcome().ball_measured) {
    last = env.step(choose(env.state())).last;
  }
  if (!env.outcome().ball_measured) {
    env.coast();
  }
  return env.outcome();
}

}  // namespace striker::training
