#include "kick_env.hpp"

#include <cmath>

namespace striker::training {

namespace {

std::variant<sil::PlanarWorld, sil::World> make_world(World world) {
  if (world == World::fast) {
    return sil::PlanarWorld(physics_step_s);
  }
  return sil::World(sil::kick_world(physics_step_s));
}

}  // namespace

KickEnv::KickEnv(const EnvConfig& config) : config_(config), world_(make_world(config.world)) {}

void KickEnv::reset(const sil::KickStart& start) {
  std::visit([&](auto& world) { episode_.begin(world, start); }, world_);
  last_ball_m_ = sil::ball_before(start, sil::decision_period_s).position_m;
  decisions_ = 0;
  observe();
}

StepResult KickEnv::step(int action) {
  std::visit([&](const auto& world) { last_ball_m_ = world.ball().position_m; }, world_);
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
  std::visit(
      [&](auto& world) {
        world.servo_wheel(0, sil::Wheel::left, set_point_m_s, torque_ceiling_Nm);
        world.servo_wheel(0, sil::Wheel::right, set_point_m_s, torque_ceiling_Nm);
        for (int i = 0; i < steps; ++i) {
          episode_.step(world);
        }
      },
      world_);
  simulated_s_ += steps * physics_step_s;
}

void KickEnv::observe() {
  std::visit(
      [&](const auto& world) {
        Observation seen{.robot = world.robot_pose(0),
                         .robot_velocity_m_s = world.robot_velocity_m_s(0),
                         .ball = world.ball()};
        if (config_.velocities == Velocities::estimated) {
          const double speed_m_s =
              0.5 * (world.rim_speed_m_s(0, sil::Wheel::left) + world.rim_speed_m_s(0, sil::Wheel::right));
          seen.robot_velocity_m_s = {speed_m_s * std::cos(seen.robot.heading_rad),
                                     speed_m_s * std::sin(seen.robot.heading_rad)};
          seen.ball.velocity_m_s = {(seen.ball.position_m.x - last_ball_m_.x) / sil::decision_period_s,
                                    (seen.ball.position_m.y - last_ball_m_.y) / sil::decision_period_s};
        }
        state_ = rcs_state(seen, config_.equations);
      },
      world_);
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
