// SPDX-License-Identifier: Apache-2.0
#include "sil/task/kick_task.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sil/world/field_specs.hpp"
#include "sil/world/physics_constants.hpp"
#include "sil/world/planar_world.hpp"
#include "sil/world/random.hpp"
#include "sil/world/random_streams.hpp"

namespace striker::sil {
namespace {

constexpr double pi = std::numbers::pi;

constexpr double ball_distance_m = 2.0;

constexpr double kick_angle_rad = 15.0 * pi / 180.0;
constexpr double kick_speed_m_s = 1.0;

constexpr double aimed_reward_s_m = 2.0;
constexpr double least_aimed_reward = -4.0;

Vec2 along(double direction_rad) {
  return {std::cos(direction_rad), std::sin(direction_rad)};
}
Vec2 operator+(Vec2 a, Vec2 b) {
  return {a.x + b.x, a.y + b.y};
}
Vec2 operator-(Vec2 a, Vec2 b) {
  return {a.x - b.x, a.y - b.y};
}
Vec2 operator*(double factor, Vec2 a) {
  return {factor * a.x, factor * a.y};
}
double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
double angle_rad(Vec2 a) {
  return std::atan2(a.y, a.x);
}
double wrapped_rad(double angle) {
  return std::remainder(angle, 2.0 * pi);
}

Vec2 rotated(Vec2 a, double angle) {
  const Vec2 axis = along(angle);
  return {axis.x * a.x - axis.y * a.y, axis.y * a.x + axis.x * a.y};
}

Pose draw_pose(std::uint64_t seed, std::uint64_t episode) {
  Random random(seed, episode, random_stream::pose);
  Pose pose;
  pose.x_m = random.uniform(-field_half_length_m, field_half_length_m);
  pose.y_m = random.uniform(-field_half_width_m, field_half_width_m);
  pose.heading_rad = random.uniform(-pi, pi);
  return pose;
}

// In the robot's frame.
BallState draw_ball(std::uint64_t seed, std::uint64_t episode, const KickRules& rules) {
  Random random(seed, episode, random_stream::ball);
  const Vec2 from = ball_distance_m * along(random.uniform(-pi, pi));
  const double speed_m_s = random.uniform(rules.slowest_ball_m_s, rules.fastest_ball_m_s);
  const double aim_distance_m = rules.aim_radius_m * std::sqrt(random.uniform());
  const Vec2 aim = aim_distance_m * along(random.uniform(-pi, pi));
  return {.position_m = from, .velocity_m_s = speed_m_s * along(angle_rad(aim - from))};
}

}  // namespace

KickStart draw_kick(std::uint64_t seed, std::uint64_t episode, PoseMode pose, const KickRules& rules) {
  KickStart start;
  if (pose == PoseMode::anywhere) {
    start.robot = draw_pose(seed, episode);
  }
  const BallState ball = draw_ball(seed, episode, rules);
  const Vec2 centre{start.robot.x_m, start.robot.y_m};
  start.ball.position_m = centre + rotated(ball.position_m, start.robot.heading_rad);
  start.ball.velocity_m_s = rotated(ball.velocity_m_s, start.robot.heading_rad);
  return start;
}

double aimed_reward(Vec2 ball_velocity_m_s, double target_heading_rad) {
  const Vec2 target = along(target_heading_rad);
  const double along_m_s = dot(ball_velocity_m_s, target);
  const double across_m_s = target.x * ball_velocity_m_s.y - target.y * ball_velocity_m_s.x;
  return std::max(least_aimed_reward, aimed_reward_s_m * (along_m_s - std::abs(across_m_s)));
}

BallState ball_before(const KickStart& start, double ahead_s) {
  const double faster = std::exp(damping_per_s * ahead_s);
  const double way_s = (faster - 1.0) / damping_per_s;
  return {.position_m = start.ball.position_m - way_s * start.ball.velocity_m_s,
          .velocity_m_s = faster * start.ball.velocity_m_s};
}

WorldConfig kick_world(double step_s, const KickPlace& place) {
  return {.robots = {place.robot},
          .walls = false,
          .step_s = step_s,
          .ball_kept_after_1_s = place.ball_kept_after_1_s};
}

template <KickWorld W>
void KickEpisode::begin(W& world, const KickStart& start) {
  world.place_robot(0, start.robot);
  world.place_ball(start.ball);
  *this = KickEpisode(rules_);
  target_heading_rad_ = start.robot.heading_rad;
}

template <KickWorld W>
void KickEpisode::step(W& world) {
  const Pose robot = world.robot_pose(0);
  const Vec2 robot_velocity = world.robot_velocity_m_s(0);
  const Vec2 ball = world.ball().position_m;
  world.step();
  if (outcome_.contact && !outcome_.ball_measured && --steps_to_measurement_ == 0) {
    measure_ball(world.ball().velocity_m_s);
  }
  const bool pays =
      decision_ < kick_decisions && !contact_due_ && (!outcome_.contact || rules_.every_contact);
  const auto normal = pays ? world.ball_contact(0) : std::nullopt;
  if (!normal) {
    return;
  }
  const Vec2 heading = along(robot.heading_rad);
  const double theta_rad = wrapped_rad(angle_rad(ball - Vec2{robot.x_m, robot.y_m}) - target_heading_rad_);
  const double v_m_s = dot(robot_velocity, heading);
  contact_due_ = true;
  contact_reward_ = rules_.reward == KickReward::aimed
                        ? 0.0
                        : rules_.angle_reward * std::cos(theta_rad) +
                              rules_.speed_reward_s_m * (rules_.signed_speed ? v_m_s : std::abs(v_m_s));
  if (!outcome_.contact) {
    outcome_.contact = true;
    outcome_.contact_decision = decision_;
    outcome_.theta_contact_rad = theta_rad;
    outcome_.v_contact_m_s = v_m_s;
    // The faces' normals are 90 degrees apart, and those at an edge lie between: within 45 degrees of the
    // heading the front face is the nearest.
    outcome_.front_face = dot(*normal, heading) > std::cos(0.25 * pi);
    steps_to_measurement_ = static_cast<int>(std::lround(measured_after_s / world.step_s()));
  }
}

void KickEpisode::measure_ball(Vec2 velocity_m_s) {
  outcome_.ball_measured = true;
  outcome_.ball_speed_m_s = std::hypot(velocity_m_s.x, velocity_m_s.y);
  outcome_.ball_angle_rad = wrapped_rad(angle_rad(velocity_m_s) - target_heading_rad_);
  outcome_.kicked = outcome_.front_face && outcome_.ball_speed_m_s > kick_speed_m_s &&
                    std::abs(outcome_.ball_angle_rad) <= kick_angle_rad;
  if (rules_.reward == KickReward::aimed) {
    (contact_due_ ? contact_reward_ : outcome_.reward) += aimed_reward(velocity_m_s, target_heading_rad_);
  }
}

double KickEpisode::end_decision() {
  if (decision_ >= kick_decisions) {
    return 0.0;
  }
  ++decision_;
  const double waiting = outcome_.contact ? 0.0 : rules_.waiting_reward;
  const double reward = contact_due_ ? contact_reward_ : waiting;
  contact_due_ = false;
  outcome_.reward += reward;
  return reward;
}

template void KickEpisode::begin(World&, const KickStart&);
template void KickEpisode::begin(PlanarWorld&, const KickStart&);
template void KickEpisode::step(World&);
template void KickEpisode::step(PlanarWorld&);

}  // namespace striker::sil
