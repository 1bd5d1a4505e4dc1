// SPDX-License-Identifier: Apache-2.0
#include "training/ceiling/rivals.hpp"

#include <cmath>

#include "sil/world/field_specs.hpp"
#include "sil/world/physics_constants.hpp"
#include "sil/world/random.hpp"
#include "sil/world/random_streams.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::training {

namespace {

constexpr int go_forward = 0;
constexpr int stay = 1;
constexpr int go_back = 2;

// At full throttle, to three digits: a forward's 11.1 m/s^2.
double acceleration_m_s2(const LineDrive& drive) {
  const double exact_m_s2 = drive.gain_limit_m_s / physics_step_s;
  const double digits = std::pow(10.0, 2.0 - std::floor(std::log10(exact_m_s2)));
  return std::round(digits * exact_m_s2) / digits;
}

// How long the robot takes for this way at full throttle.
double way_time_s(const LineDrive& drive, double way_m, double speed_m_s) {
  const double gain_m_s2 = acceleration_m_s2(drive);
  const double faster_m_s = drive.top_speed_m_s - speed_m_s;
  const double way_to_top_m = (speed_m_s + 0.5 * faster_m_s) * faster_m_s / gain_m_s2;
  if (way_m > way_to_top_m) {
    return faster_m_s / gain_m_s2 + (way_m - way_to_top_m) / drive.top_speed_m_s;
  }
  const double root = speed_m_s * speed_m_s + 2.0 * gain_m_s2 * way_m;
  return root < 0.0 ? 0.0 : (std::sqrt(root) - speed_m_s) / gain_m_s2;
}

}  // namespace

int intercept(const InterceptorParameters& parameters, const KickEnvironment& env) {
  const RcsState& seen = env.state();
  const sil::Vec2 ball{seen.ball_x_m, seen.ball_y_m};
  const sil::Vec2 velocity{seen.ball_vx_m_s, seen.ball_vy_m_s};
  constexpr double beside_m = 0.5 * sil::robot_side_m + sil::ball_radius_m;
  if (std::abs(ball.y) < beside_m) {
    return ball.x > 0.0 ? go_forward : stay;
  }
  // The ball slows down: its way is its speed times this, at most 1 / damping.
  const double slowed_s = -ball.y / velocity.y;
  if (!(slowed_s > 0.0) || slowed_s * sil::damping_per_s >= 1.0) {
    return stay;
  }
  const double crossing_s = -std::log(1.0 - sil::damping_per_s * slowed_s) / sil::damping_per_s;
  const double way_m = ball.x + velocity.x * slowed_s - parameters.stop_short_m;
  const double spare_s = crossing_s - way_time_s(line_drive(env.config().robot), way_m, seen.robot_speed_m_s);
  if (way_m < parameters.run_up_m && spare_s > parameters.time_to_back_up_s) {
    return go_back;
  }
  return way_m > 0.0 && spare_s < parameters.lead_s ? go_forward : stay;
}

int plan_ahead(const KickEnvironment& env) {
  const RcsState& seen = env.state();
  const int left = env.decisions_left();
  const BallTrack track = ball_track(
      {.position_m = {seen.ball_x_m, seen.ball_y_m}, .velocity_m_s = {seen.ball_vx_m_s, seen.ball_vy_m_s}},
      left * steps_per_decision);
  const PlanValue value = best_plan(line_drive(env.config().robot, env.config().rules.reward), track,
                                    {.position_m = 0.0, .speed_m_s = seen.robot_speed_m_s}, left);
  return value.contact && value.reward > left * official.waiting_reward ? value.plan.action(0) : stay;
}

std::string_view name_of(Rival rival) {
  constexpr std::array<std::string_view, all_rivals.size()> names = {"forward", "stop", "random",
                                                                     "interceptor", "planner"};
  return names.at(static_cast<std::size_t>(rival));
}

ActionRule rule_of(Rival rival, std::uint64_t seed, std::uint64_t episode) {
  switch (rival) {
    case Rival::forward:
      return [](const KickEnvironment&) { return go_forward; };
    case Rival::stop:
      return [](const KickEnvironment&) { return stay; };
    case Rival::random:
      return [random = sil::Random(seed, episode, sil::random_stream::random_rival)](
                 const KickEnvironment&) mutable {
        return static_cast<int>(random.below(kick_actions().size()));
      };
    case Rival::interceptor:
      return [](const KickEnvironment& env) { return intercept({}, env); };
    case Rival::planner:
      break;
  }
  return plan_ahead;
}

}  // namespace striker::training
