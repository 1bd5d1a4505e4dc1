// SPDX-License-Identifier: Apache-2.0
// Numbers of fields: sil/match/record/proto/ssl_vision.proto.
#include "sil/match/record/ssl/ssl_geometry.hpp"

#include <cmath>
#include <numbers>
#include <string_view>

#include "sil/match/referee/areas.hpp"
#include "sil/match/referee/free_spot.hpp"
#include "sil/match/referee/match_rules.hpp"

namespace striker::sil {
namespace {

constexpr double line_thickness_m = 0.02;
constexpr double boundary_m = 0.3;       // beyond the lines: what a viewer shows of the goals' surroundings
constexpr double penalty_mark_m = 0.95;  // before the line: where the ball lies for a penalty kick
constexpr double wall_height_m = 0.8;    // of goals too, to the ball's ceiling
constexpr MatchRules rules = official();

std::uint64_t whole_mm(double length_m) {
  return static_cast<std::uint64_t>(std::lround(length_m * 1e3));
}

float real_mm(double length_m) {
  return static_cast<float>(length_m * 1e3);
}

ProtoMessage point(Vec2 spot) {
  ProtoMessage message;
  message.real(1, real_mm(spot.x));
  message.real(2, real_mm(spot.y));
  return message;
}

ProtoMessage line(std::string_view name, Vec2 from, Vec2 to) {
  ProtoMessage message;
  message.text(1, name);
  message.message(2, point(from));
  message.message(3, point(to));
  message.real(4, real_mm(line_thickness_m));
  return message;
}

ProtoMessage centre_circle() {
  ProtoMessage message;
  message.text(1, "CenterCircle");
  message.message(2, point({}));
  message.real(3, real_mm(rules.kickoff_ball_m));
  message.real(4, 0.0F);
  message.real(5, 2.0F * std::numbers::pi_v<float>);
  message.real(6, real_mm(line_thickness_m));
  return message;
}

void add_lines(ProtoMessage& size) {
  constexpr double x = field_half_length_m;
  constexpr double y = field_half_width_m;
  constexpr double px = penalty_line_m;
  constexpr double py = penalty_half_width_m;
  constexpr int field_lines = 6;
  size.message(field_lines, line("TopTouchLine", {-x, y}, {x, y}));
  size.message(field_lines, line("BottomTouchLine", {-x, -y}, {x, -y}));
  size.message(field_lines, line("LeftGoalLine", {-x, -y}, {-x, y}));
  size.message(field_lines, line("RightGoalLine", {x, -y}, {x, y}));
  size.message(field_lines, line("HalfwayLine", {0.0, -y}, {0.0, y}));
  size.message(field_lines, line("CenterLine", {-x, 0.0}, {x, 0.0}));
  size.message(field_lines, line("LeftPenaltyStretch", {-px, -py}, {-px, py}));
  size.message(field_lines, line("RightPenaltyStretch", {px, -py}, {px, py}));
  size.message(field_lines, line("LeftFieldLeftPenaltyStretch", {-x, -py}, {-px, -py}));
  size.message(field_lines, line("LeftFieldRightPenaltyStretch", {-x, py}, {-px, py}));
  size.message(field_lines, line("RightFieldLeftPenaltyStretch", {x, py}, {px, py}));
  size.message(field_lines, line("RightFieldRightPenaltyStretch", {x, -py}, {px, -py}));
}

}  // namespace

ProtoMessage field_geometry() {
  ProtoMessage size;
  size.number(1, whole_mm(2.0 * field_half_length_m));
  size.number(2, whole_mm(2.0 * field_half_width_m));
  size.number(3, whole_mm(2.0 * goal_half_width_m));
  size.number(4, whole_mm(goal_back_m - field_half_length_m));
  size.number(5, whole_mm(boundary_m));
  add_lines(size);
  size.message(7, centre_circle());
  size.number(8, whole_mm(field_half_length_m - penalty_line_m));
  size.number(9, whole_mm(2.0 * penalty_half_width_m));
  size.number(10, whole_mm(rules.kickoff_ball_m));
  size.number(11, whole_mm(line_thickness_m));
  size.number(12, whole_mm(penalty_mark_m));
  size.number(13, whole_mm(wall_height_m));
  size.real(14, real_mm(ball_radius_m));
  size.real(15, std::ceil(real_mm(robot_reach_m)));
  ProtoMessage geometry;
  geometry.message(1, size);
  return geometry;
}

}  // namespace striker::sil
