#include "training/task/kick_environment.hpp"

#include <cmath>

namespace striker::training {

namespace {

constexpr std::uint64_t dummies_stream = 105;

std::variant<sil::PlanarWorld, sil::World> make_world(World world) {
  if (world == World::fast) {
    return sil::PlanarWorld(physics_step_s);
  }
  return sil::World(sil::kick_world(physics_step_s));
}

}  // namespace

std::vector<SetPoints> kick_actions() {
  constexpr double steady_m_s = 2.55;
  return {{steady_m_s, steady_m_s}, {0.0, 0.0}, {-steady_m_s, -steady_m_s}};
}

int mirrored_action(const std::vector<SetPoints>& actions, int action) {
  const SetPoints& image = actions[static_cast<std::size_t>(action)];
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (actions[i].left_m_s == image.right_m_s && actions[i].right_m_s == image.left_m_s) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

KickEnv::KickEnv(const EnvConfig& config)
    : config_(config),
      world_(make_world(config.world)),
      episode_(config.rules),
      dummies_(0, 0, dummies_stream),
      features_(config.inputs.size()) {}

void KickEnv::reset(std::uint64_t seed, std::uint64_t episode) {
  const sil::KickStart start = sil::draw_kick(seed, episode, config_.pose, config_.rules);
  std::visit([&](auto& world) { episode_.begin(world, start); }, world_);
  last_ball_m_ = sil::ball_before(start, sil::decision_period_s).position_m;
  dummies_ = sil::Random(seed, episode, dummies_stream);
  decisions_ = 0;
  history_.begin(look());
  see(config_.inputs, history_, in_mirror(), dummies_, features_);
}

StepResult KickEnv::step(int action) {
  last_ball_m_ = history_.ago(0).field.ball.position_m;
  const bool before = outcome().contact;
  const auto [left_m_s, right_m_s] = config_.actions[static_cast<std::size_t>(action)];
  drive(in_mirror() ? SetPoints{right_m_s, left_m_s} : SetPoints{left_m_s, right_m_s}, steps_per_decision);
  StepResult result;
  result.reward = episode_.end_decision();
  ++decisions_;
  history_.add(look());
  see(config_.inputs, history_, in_mirror(), dummies_, features_);
  result.contact = outcome().contact && !before;
  result.last = decisions_ == sil::kick_decisions;
  result.end = result.last || (result.contact && !config_.goes_on);
  return result;
}

void KickEnv::coast() {
  drive({}, 2 * steps_per_decision);
}

void KickEnv::drive(const SetPoints& set_points, int steps) {
  std::visit(
      [&](auto& world) {
        world.servo_wheel(0, sil::Wheel::left, set_points.left_m_s, torque_ceiling_Nm);
        world.servo_wheel(0, sil::Wheel::right, set_points.right_m_s, torque_ceiling_Nm);
        for (int i = 0; i < steps; ++i) {
          episode_.step(world);
        }
      },
      world_);
  simulated_s_ += physics_step_s * steps;
}

Sight KickEnv::look() const {
  Sight sight;
  sight.decisions_left = sil::kick_decisions - decisions_;
  std::visit(
      [&](const auto& world) {
        Observation& seen = sight.field;
        seen = {.robot = world.robot_pose(0),
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
      },
      world_);
  sight.rcs = rcs_state(sight.field, config_.equations);
  return sight;
}

sil::KickOutcome play(KickEnv& env, std::uint64_t seed, std::uint64_t episode, const Choice& choose) {
  env.reset(seed, episode);
  bool last = false;
  while (!last && !env.outcome().ball_measured) {
    last = env.step(choose(env)).last;
  }
  if (!env.outcome().ball_measured) {
    env.coast();
  }
  return env.outcome();
}

}  // namespace striker::training
