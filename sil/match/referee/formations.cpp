// SPDX-License-Identifier: Apache-2.0
#include "sil/match/referee/formations.hpp"

#include <numbers>

namespace striker::sil {
namespace {

constexpr double ahead = 0.0;
constexpr double left = 0.5 * std::numbers::pi;
constexpr double back = std::numbers::pi;
constexpr double right = -left;

constexpr Pose keeper_spot = {-3.8, 0.0, left};

// In the order of Formation.
constexpr std::array<TeamSpots, 13> formations = {{
    {{keeper_spot, {-2.25, 1.0, ahead}, {-2.25, -1.0, ahead}, {-0.65, 0.3, ahead}, {-0.65, -0.3, ahead}}},
    {{keeper_spot, {-2.25, 1.0, ahead}, {-2.25, -1.0, ahead}, {-0.9, 0.0, ahead}, {0.4, 0.0, back}}},
    {{{-3.8, 0.0, ahead},
      {-2.5, 0.45, ahead},
      {-2.5, -0.45, ahead},
      {-1.5, 0.8, ahead},
      {-1.5, -0.8, ahead}}},
    {{keeper_spot, {-0.5, 0.8, ahead}, {-0.5, -0.8, ahead}, {0.5, 0.45, ahead}, {0.5, -0.45, ahead}}},
    {{keeper_spot, {2.25, -1.0, left}, {3.25, -1.0, left}, {2.25, 0.0, ahead}, {2.75, -2.0, left}}},
    {{keeper_spot, {3.25, 1.0, right}, {2.25, 1.0, right}, {2.25, 0.0, ahead}, {2.75, 2.0, right}}},
    {{keeper_spot, {-3.25, 0.5, left}, {-3.25, -0.5, left}, {-2.25, 0.5, left}, {-2.25, -0.5, left}}},
    {{keeper_spot, {-3.25, 0.5, right}, {-3.25, -0.5, right}, {-2.25, 0.5, right}, {-2.25, -0.5, right}}},
    {{keeper_spot, {-2.25, 1.0, right}, {-3.25, 1.0, right}, {-3.25, 0.0, ahead}, {-2.75, 2.0, right}}},
    {{keeper_spot, {-3.25, -1.0, left}, {-2.25, -1.0, left}, {-3.25, 0.0, ahead}, {-2.75, -2.0, left}}},
    {{keeper_spot, {-1.5, 0.45, ahead}, {-1.5, -0.45, ahead}, {-0.5, 0.8, ahead}, {-0.5, -0.8, ahead}}},
    {{keeper_spot, {0.5, -0.8, ahead}, {1.0, -0.8, ahead}, {1.5, -0.8, ahead}, {2.0, 0.0, ahead}}},
    {{keeper_spot, {-1.5, -0.8, left}, {-1.5, -1.05, left}, {-1.25, -0.8, left}, {-1.25, -1.05, left}}},
}};

constexpr double slot_x_m = -4.05;
constexpr double first_slot_y_m = -0.85;
constexpr double between_slots_m = 0.3;

constexpr Vec2 goal_kick_ball = {-3.25, 0.0};  // in the owner's frame
constexpr Vec2 penalty_ball = {2.95, 0.0};
constexpr Vec2 corner_ball = {2.75, 1.5};
constexpr Vec2 dropped_ball = {1.5, 1.0};

Vec2 in_frame_of(Team team, Vec2 spot) {
  return team == Team::red ? spot : turned(spot);
}

Vec2 in_quadrant_of(Vec2 ball, Vec2 spot) {
  return {ball.x < 0.0 ? -spot.x : spot.x, ball.y > 0.0 ? spot.y : -spot.y};
}

struct Sides {
  Formation owner;
  Formation other;
  Vec2 ball;  // in the owner's frame
};

Sides corner(Vec2 ball) {
  const bool high = ball.y > 0.0;
  if (ball.x > 0.0) {
    return high ? Sides{Formation::corner_theirs_high, Formation::against_corner_low, ball}
                : Sides{Formation::corner_theirs_low, Formation::against_corner_high, ball};
  }
  return {high ? Formation::corner_ours_high : Formation::corner_ours_low, Formation::against_corner_far,
          ball};
}

Sides sides_of(GameState set_piece, Team owner, Vec2 stopped_ball) {
  switch (set_piece) {
    case GameState::goal_kick:
      return {Formation::goal_kick, Formation::against_goal_kick, goal_kick_ball};
    case GameState::corner:
      return corner(in_frame_of(owner, in_quadrant_of(stopped_ball, corner_ball)));
    case GameState::penalty:
      return {Formation::penalty, Formation::against_penalty, penalty_ball};
    default:
      return {Formation::kickoff, Formation::home, {}};
  }
}

}  // namespace

const TeamSpots& spots_of(Formation formation) {
  return formations[static_cast<std::size_t>(formation)];
}

Pose home_spot(std::size_t id) {
  return spots_of(Formation::home)[id];
}

Pose slot(std::size_t id) {
  return {slot_x_m, first_slot_y_m - between_slots_m * static_cast<double>(id), ahead};
}

LineUp line_up_of(GameState set_piece, Team owner, Vec2 stopped_ball) {
  const Sides sides = sides_of(set_piece, owner, stopped_ball);
  LineUp line_up;
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    const Team team = team_of(robot);
    const Pose spot = spots_of(team == owner ? sides.owner : sides.other)[id_of(robot)];
    line_up.robots[robot] = team == Team::red ? spot : turned(spot);
  }
  line_up.ball = in_frame_of(owner, sides.ball);
  return line_up;
}

Vec2 drop_spot(Vec2 stopped_ball) {
  return in_quadrant_of(stopped_ball, dropped_ball);
}

std::size_t kicker_of(GameState set_piece, Team owner) {
  return robot_of(owner, set_piece == GameState::goal_kick ? goalkeeper_id : kicker_id);
}

}  // namespace striker::sil
