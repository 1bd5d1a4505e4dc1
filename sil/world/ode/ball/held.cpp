// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/ball/held.hpp"

#include <algorithm>
#include <array>

#include "sil/world/field_specs.hpp"
#include "sil/world/ode/ball/flight.hpp"
#include "sil/world/ode/ball/walls.hpp"

namespace striker::sil {
namespace {

// What a motor or another robot adds to the speed of a push within a step.
constexpr double push_margin_m_s = 0.5;

// Of the robot's body where the ball's centre is.
Vec3 speed_beside(const Robot& robot, const Vec3& at_m) {
  dVector3 velocity;
  dBodyGetPointVel(robot.body, at_m.x, at_m.y, at_m.z, velocity);
  return {velocity[0], velocity[1], velocity[2]};
}

using Gaps = std::array<WallGap, ball_wall_count>;

Gaps gaps_of(const Vec3& centre_m) {
  Gaps gaps{};
  wall_gaps(centre_m, gaps);
  return gaps;
}

// On this side of the ball, its normal towards the robot.
std::optional<dContactGeom> touch(const Robot& robot, const Ball& ball) {
  dContactGeom contact;
  if (!may_touch(robot, ball) ||
      dCollide(robot.box.get(), ball.geom.get(), 1, &contact, sizeof(contact)) == 0) {
    return {};
  }
  return contact;
}

Vec3 normal_of(const dContactGeom& contact) {
  return {contact.normal[0], contact.normal[1], contact.normal[2]};
}

bool reaches(const WallGap& wall, const Vec3& velocity_m_s, double step_s) {
  return wall.gap_m <= step_s * (push_margin_m_s - dot(wall.normal, velocity_m_s));
}

}  // namespace

bool is_held(const Ball& ball, std::span<const Robot> robots, bool has_walls, double step_s) {
  const BallMotion motion = motion_of(ball);
  int touching = 0;
  bool at_wall = false;
  for (const Robot& robot : robots) {
    if (!touch(robot, ball)) {
      continue;
    }
    ++touching;
    if (has_walls && !at_wall) {
      const Vec3 push_m_s = speed_beside(robot, motion.position_m);
      at_wall = std::ranges::any_of(gaps_of(motion.position_m), [&](const WallGap& wall) {
        return reaches(wall, push_m_s, step_s) || reaches(wall, motion.velocity_m_s, step_s);
      });
    }
  }
  return touching > 1 || at_wall;
}

void join_held_ball_to_walls(const Ball& ball, Contacts& contacts, double step_s) {
  constexpr double furthest_m = 0.03;  // as far as a robot pushes it in a step
  // A contact that is exactly at rest is a tie to the solver; see tie_break.
  constexpr double untied_m_s = 1e-4;
  const Vec3 centre_m = motion_of(ball).position_m;
  for (const WallGap& wall : gaps_of(centre_m)) {
    if (wall.gap_m < furthest_m) {
      contacts.stop_at(ball.body, centre_m - ball_radius_m * wall.normal, wall.normal,
                       std::max(wall.gap_m, 0.0) / step_s + untied_m_s, Pair::held_wall_ball);
    }
  }
}

void note_pushes_through(const Ball& ball, std::span<const Robot> robots, bool has_walls, double step_s,
                         PileUp& pile_up) {
  // Friction at the ball holds a push that is straight enough, 45 degrees; others squeeze it out.
  constexpr double against = -0.7;
  const Gaps gaps = gaps_of(motion_of(ball).position_m);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const auto mine = touch(robots[i], ball);
    if (!mine) {
      continue;
    }
    for (const WallGap& wall : gaps) {
      if (has_walls && dot(wall.normal, normal_of(*mine)) > -against) {
        pile_up.note_through_ball(i, {}, *mine, std::max(wall.gap_m, 0.0) / step_s);
      }
    }
    for (std::size_t j = i + 1; j < robots.size(); ++j) {
      const auto other = touch(robots[j], ball);
      if (other && dot(normal_of(*other), normal_of(*mine)) < against) {
        pile_up.note_through_ball(i, j, *mine, 0.0);
      }
    }
  }
}

}  // namespace striker::sil
