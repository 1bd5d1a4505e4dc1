// SPDX-License-Identifier: Apache-2.0
// What a referee sees of a match: one frame, every 50 ms of simulated time, in pauses too.
//
// Field frame: x along the field, y to the left of it, origin in the centre, metres, headings anticlockwise from +x.
// It does not turn at half-time, the teams do: red plays to +x in the first half and to -x in the second. A team's
// own frame has x to the opponent's goal, so that it is the field frame or the field frame turned by pi.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "sil/world/pose.hpp"

namespace striker::sil {

enum class Team : std::uint8_t { red, blue };
inline constexpr std::array teams = {Team::red, Team::blue};

[[nodiscard]] constexpr Team opponent_of(Team team) {
  return team == Team::red ? Team::blue : Team::red;
}
[[nodiscard]] constexpr std::size_t index_of(Team team) {
  return static_cast<std::size_t>(team);
}

// Robots are counted through: red's are 0 to 4, blue's 5 to 9. In a team 0 is the goalkeeper, 1 and 2 are defenders,
// 3 and 4 forwards.
inline constexpr std::size_t robots_a_team = 5;
inline constexpr std::size_t robots_in_match = 2 * robots_a_team;
inline constexpr std::size_t goalkeeper_id = 0;
inline constexpr std::size_t kicker_id = 4;  // of a kickoff, corner or penalty kick

[[nodiscard]] constexpr std::size_t robot_of(Team team, std::size_t id) {
  return index_of(team) * robots_a_team + id;
}
[[nodiscard]] constexpr Team team_of(std::size_t robot) {
  return robot < robots_a_team ? Team::red : Team::blue;
}
[[nodiscard]] constexpr std::size_t id_of(std::size_t robot) {
  return robot % robots_a_team;
}

using RobotSet = std::bitset<robots_in_match>;

[[nodiscard]] inline RobotSet robots_of(Team team) {
  return RobotSet(0b11111U) << robot_of(team, 0);
}

struct BallSeen {
  Vec2 position_m;
  double height_m = 0.05;  // of its centre above the floor
  double speed_m_s = 0.0;  // in space
};

// Any value is taken. One that is no number passes no test: such a ball is neither in a goal nor out nor fast, such a
// robot is in no area and in nobody's way.
struct RefereeFrame {
  std::array<Pose, robots_in_match> robots = {};  // one that was sent out: where it was placed
  RobotSet standing = RobotSet().set();           // upright: AI Soccer says so to a tilt of 36.9 degrees
  RobotSet touching;  // had a contact of its body with the ball since the last frame
  BallSeen ball;
};

// A spot, a pose or a frame as somebody at the other end of the field sees it. Headings come out in (-pi, pi] if they
// went in so.
[[nodiscard]] constexpr Vec2 turned(Vec2 spot) {
  return {-spot.x, -spot.y};
}
[[nodiscard]] constexpr Pose turned(const Pose& pose) {
  constexpr double pi = std::numbers::pi;
  return {-pose.x_m, -pose.y_m, pose.heading_rad > 0.0 ? pose.heading_rad - pi : pose.heading_rad + pi};
}
[[nodiscard]] inline RefereeFrame turned(const RefereeFrame& frame) {
  RefereeFrame result = frame;
  for (Pose& pose : result.robots) {
    pose = turned(pose);
  }
  result.ball.position_m = turned(frame.ball.position_m);
  return result;
}

}  // namespace striker::sil
