// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/ball/flight.hpp"

#include <algorithm>

#include "sil/world/field_specs.hpp"
#include "sil/world/ode/ball/walls.hpp"
#include "sil/world/ode/materials.hpp"

namespace striker::sil {
namespace {

Vec3 vector(const dReal* from) {
  return {from[0], from[1], from[2]};
}

}  // namespace

BallMotion motion_of(const Ball& ball) {
  return {.position_m = vector(dBodyGetPosition(ball.body)),
          .velocity_m_s = vector(dBodyGetLinearVel(ball.body)),
          .spin_rad_s = vector(dBodyGetAngularVel(ball.body))};
}

BallMotion after_impact(const BallMotion& ball, const Vec3& normal, Bounce bounce) {
  const double approach_m_s = -dot(ball.velocity_m_s, normal);
  if (approach_m_s <= 0.0) {
    return ball;
  }
  const dSurfaceParameters wall = surface(Pair::wall_ball, reference_step_s);
  const bool bounces = bounce == Bounce::table && approach_m_s > wall.bounce_vel;
  // Impulses per mass.
  const double push_m_s = (1.0 + (bounces ? wall.bounce : 0.0)) * approach_m_s;
  BallMotion after = ball;
  after.velocity_m_s = ball.velocity_m_s + push_m_s * normal;
  const Vec3 slip_m_s =
      ball.velocity_m_s + approach_m_s * normal - ball_radius_m * cross(ball.spin_rad_s, normal);
  const double slip = length(slip_m_s);
  if (slip > 0.0) {
    constexpr double sphere_share = 2.0 / 7.0;
    constexpr double inertia_share = 2.0 / 5.0;  // of mass times radius squared
    const double rub_m_s = std::min(sphere_share * slip, wall.mu * push_m_s);
    const Vec3 rub = (-rub_m_s / slip) * slip_m_s;
    after.velocity_m_s = after.velocity_m_s + rub;
    after.spin_rad_s = ball.spin_rad_s - (1.0 / (inertia_share * ball_radius_m)) * cross(normal, rub);
  }
  return after;
}

void bounce_off_walls(const Ball& ball, const Vec3& from_m, double step_s, Bounce bounce) {
  constexpr int most_bounces = 6;  // a corner takes two or three
  BallMotion motion = motion_of(ball);
  const double moving_s = step_s / (1.0 - dBodyGetLinearDamping(ball.body));  // with the damped speed
  Vec3 from = from_m;
  Vec3 way = motion.position_m - from_m;
  double share_left = 1.0;
  int bounces = 0;
  for (auto hit = first_wall_hit(from, way); hit; hit = first_wall_hit(from, way)) {
    from = from + hit->share * way;
    if (++bounces > most_bounces) {
      way = {};
      break;
    }
    share_left *= 1.0 - hit->share;
    motion = after_impact(motion, hit->normal, bounce);
    way = (share_left * moving_s) * motion.velocity_m_s;
  }
  if (bounces == 0) {
    return;
  }
  const Vec3 to = from + way;
  dBodySetPosition(ball.body, to.x, to.y, to.z);
  dBodySetLinearVel(ball.body, motion.velocity_m_s.x, motion.velocity_m_s.y, motion.velocity_m_s.z);
  dBodySetAngularVel(ball.body, motion.spin_rad_s.x, motion.spin_rad_s.y, motion.spin_rad_s.z);
}

void keep_above_floor(const Ball& ball) {
  constexpr double deepest_m = 0.001;
  const dReal* position = dBodyGetPosition(ball.body);
  if (position[2] < ball_radius_m - deepest_m) {
    dBodySetPosition(ball.body, position[0], position[1], ball_radius_m - deepest_m);
  }
}

}  // namespace striker::sil
