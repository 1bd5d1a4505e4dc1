// SPDX-License-Identifier: Apache-2.0
#include "training/line/leaving_ball.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sil/task/kick_task.hpp"
#include "sil/world/field_specs.hpp"
#include "sil/world/planar_collision.hpp"

namespace striker::training {

namespace {

// The step that finds the contact, and those until the ball is measured.
constexpr int steps_to_measurement = 1 + sil::measured_after_ms / physics_step_ms;

double gain_limit_m_s(const Bodies& bodies) {
  return sil::straight_gain_limit_m_s(bodies.robot, {.torque_ceiling_Nm = bodies.torque_ceiling_Nm},
                                      physics_step_s);
}

// The bodies that it holds are the last contact's: most have the same.
class Collision {
 public:
  explicit Collision(const Bodies& bodies)
      : bodies_(bodies),
        ode_({.walls = false, .step_s = physics_step_s, .ball_kept_after_1_s = bodies.ball_kept_after_1_s},
             bodies.robot) {}

  sil::PlanarCollision& of(const Bodies& bodies) {
    if (bodies != bodies_) {
      bodies_ = bodies;
      ode_.become(bodies.robot, bodies.ball_kept_after_1_s);
    }
    return ode_;
  }

 private:
  Bodies bodies_;
  sil::PlanarCollision ode_;
};

// Whether robot and ball surely do not meet in the next steps: they part faster than all that can bring them together.
bool parted(const Bodies& bodies, const sil::PlanarRobot& robot, const sil::BallState& ball, int steps) {
  constexpr double half_diagonal_m = 0.70711 * sil::robot_side_m;
  // What a ball that falls back on the floor loses there at once.
  constexpr double spare_m = 0.02;
  constexpr double ball_loss_m_s = 0.03;
  const double change_m_s = ball_loss_m_s + gain_limit_m_s(bodies);
  const sil::Vec2 apart_m{ball.position_m.x - robot.pose.x_m, ball.position_m.y - robot.pose.y_m};
  const sil::Vec2 parting_m_s{ball.velocity_m_s.x - robot.velocity_m_s.x,
                              ball.velocity_m_s.y - robot.velocity_m_s.y};
  for (int step = 1; step <= steps; ++step) {
    const double after_s = physics_step_s * step;
    const double distance_m =
        std::hypot(apart_m.x + after_s * parting_m_s.x, apart_m.y + after_s * parting_m_s.y);
    const double nearer_m = 0.5 * after_s * (step + 1) * change_m_s;
    if (distance_m - nearer_m < half_diagonal_m + sil::ball_radius_m + spare_m) {
      return false;
    }
  }
  return true;
}

// A ball that bounces off leaves with 1.8 times the robot's speed and 0.8 times its own; one that does not is pushed, by a
// robot that gains speed. What crosses costs where it leaves the robot's face, less at a faster kick, as the face rubs
// more; a corner that it comes in over turns a part of it forward. The figures are what nearly all of 500,000 random
// contacts of the forward got at most, with balls of up to 3 m/s; rewards below the least bound they say nothing of.
constexpr double least_bound = 4.0;

// The bounds, of a robot at speed v: steep * v + from, whatever the place.
struct SpeedBound {
  double steep;
  double from;
};

// The greatest of them holds.
std::array<SpeedBound, 4> bounds_of(const Bodies& bodies, const sil::BallState& ball) {
  constexpr double half_side_m = 0.5 * sil::robot_side_m;
  constexpr double bounce = 3.6;
  const double side_m = std::abs(ball.position_m.y) - half_side_m;
  const double along_m_s = ball.velocity_m_s.x;
  const double crossing_m_s = std::abs(ball.velocity_m_s.y);
  const double bounced = -1.6 * along_m_s;
  const double pushed = 0.5 + 2.0 * steps_to_measurement * gain_limit_m_s(bodies);
  const auto with = [&](const SpeedBound& face, const SpeedBound& rubbed, double push) {
    return std::array<SpeedBound, 4>{
        face, rubbed, {.steep = 2.0, .from = push}, {.steep = 0.0, .from = 2.0 * along_m_s + push}};
  };
  if (side_m <= 0.0) {
    const double rub = 0.25 * crossing_m_s;
    return with({.steep = bounce, .from = bounced + 0.15 - 1.1 * crossing_m_s},
                {.steep = bounce + rub, .from = bounced + 0.15 - 1.525 * crossing_m_s - rub * along_m_s},
                pushed - 0.8 * crossing_m_s);
  }
  const double corner = side_m / sil::ball_radius_m;  // 0 at its front end, 1 where the ball passes
  const bool comes_in = ball.position_m.y * ball.velocity_m_s.y < 0.0;
  const double turned = comes_in ? 0.75 * crossing_m_s : 0.0;
  const SpeedBound face{.steep = bounce,
                        .from = bounced + (comes_in ? 0.4 + turned - 6.0 * std::max(0.0, corner - 0.5)
                                                    : 0.1 - 0.5 * crossing_m_s - 6.0 * corner)};
  return with(face, face, pushed + turned);
}

double paid(const Waited& waited) {
  return waited.reward_a_decision * waited.decisions;
}

}  // namespace

sil::Vec2 leaving_ball_m_s(const Bodies& bodies, const LineState& state, const sil::BallState& coming,
                           const Push& push) {
  thread_local Collision held(bodies);
  sil::PlanarCollision& collision = held.of(bodies);
  sil::PlanarRobot robot = sil::planar_robot({.x_m = state.position_m, .y_m = 0.0, .heading_rad = 0.0});
  robot.velocity_m_s = {state.speed_m_s, 0.0};
  sil::BallState ball = coming;
  collision.begin(robot, ball);
  int step = 0;
  do {
    const sil::WheelServo servo{.rim_speed_m_s = push.at(step),
                                .torque_ceiling_Nm = bodies.torque_ceiling_Nm};
    collision.step({servo, servo});
    collision.read(robot, ball);
    ++step;
  } while (step < steps_to_measurement && !parted(bodies, robot, ball, steps_to_measurement - step));
  for (; step < steps_to_measurement; ++step) {
    collision.step_ball();
  }
  collision.read(robot, ball);
  return ball.velocity_m_s;
}

double aimed_contact_reward(const Bodies& bodies, const LineState& robot, const sil::BallState& ball,
                            const Push& push, const Waited& waited, double to_beat) {
  const double most = most_aimed_reward(bodies, robot.speed_m_s, ball, waited);
  return most > to_beat ? paid(waited) + sil::aimed_reward(leaving_ball_m_s(bodies, robot, ball, push), 0.0)
                        : most;
}

double most_aimed_reward(const Bodies& bodies, double robot_speed_m_s, const sil::BallState& ball,
                         const Waited& waited) {
  double most = least_bound;
  for (const auto& [steep, from] : bounds_of(bodies, ball)) {
    most = std::max(most, steep * robot_speed_m_s + from);
  }
  return paid(waited) + most;
}

double least_speed_for_m_s(const Bodies& bodies, double reward, const sil::BallState& ball,
                           const Waited& waited) {
  constexpr double any = -std::numeric_limits<double>::infinity();
  const double contact = reward - paid(waited);
  double least_m_s = contact < least_bound ? any : -any;
  for (const auto& [steep, from] : bounds_of(bodies, ball)) {
    if (steep > 0.0) {
      least_m_s = std::min(least_m_s, (contact - from) / steep);
    } else if (from > contact) {
      least_m_s = any;
    }
  }
  return least_m_s;
}

}  // namespace striker::training
