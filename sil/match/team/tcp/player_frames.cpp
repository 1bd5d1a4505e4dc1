// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/tcp/player_frames.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "sil/match/referee/areas.hpp"
#include "sil/match/team/top_speed.hpp"

namespace striker::sil {

namespace {

using Json = nlohmann::ordered_json;

template <class Figure>
Json of_each_robot(Figure figure) {
  Json list = Json::array();
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    list.push_back(figure(robot_spec(role_of(id))));
  }
  return list;
}

Json robots_json(const std::array<RobotView, robots_a_team>& robots) {
  Json list = Json::array();
  for (const auto& [pose, active, touching] : robots) {
    list.push_back({pose.x_m, pose.y_m, 0.0, pose.heading_rad, active, touching, false});
  }
  return list;
}

// The numbers of its messages: 0 to 4.
int number_of(GameState state) {
  return is_set_piece(state) ? static_cast<int>(state) : 0;
}

int number_of(ResetReason reason, bool own_team_scored) {
  if (reason == ResetReason::red_scored || reason == ResetReason::blue_scored) {
    return own_team_scored ? 2 : 3;
  }
  return static_cast<int>(reason);
}

}  // namespace

std::string player_info(int half_ms) {
  const Json nobody = {{{"name_a", ""}, {"rating", 0}}, {{"name_b", ""}, {"rating", 0}}};
  const Json info = {
      {"field", {2.0 * field_half_length_m, 2.0 * field_half_width_m}},
      {"goal", {goal_back_m - field_half_length_m, 2.0 * goal_half_width_m}},
      {"penalty_area", {field_half_length_m - penalty_line_m, 2.0 * penalty_half_width_m}},
      {"goal_area", {field_half_length_m - goal_area_line_m, 2.0 * goal_area_half_width_m}},
      {"ball_radius", ball_radius_m},
      {"ball_mass", ball_mass_kg},
      {"robot_size", of_each_robot([](const RobotSpec&) { return robot_side_m; })},
      {"robot_height", of_each_robot([](const RobotSpec&) { return robot_top_m; })},
      {"axle_length", of_each_robot([](const RobotSpec& robot) { return robot.axle_length_m; })},
      {"robot_body_mass", of_each_robot([](const RobotSpec& robot) { return robot.body_mass_kg; })},
      {"wheel_radius", of_each_robot([](const RobotSpec& robot) { return robot.wheel_radius_m; })},
      {"wheel_mass", of_each_robot([](const RobotSpec& robot) { return robot.wheel_mass_kg; })},
      {"max_linear_velocity", of_each_robot([](const RobotSpec& robot) { return robot.max_rim_speed_m_s; })},
      {"max_torque", of_each_robot([](const RobotSpec& robot) { return robot.max_wheel_torque_Nm; })},
      {"resolution", {640, 480}},
      {"number_of_robots", robots_a_team},
      {"codewords", Json::array()},
      {"game_time", 2.0 * half_ms / 1000.0},
      {"team_info", nobody},
      {"key", ""},
      {"keyboard", false},
  };
  return info.dump();
}

std::string player_frame(const TeamView& view, const std::array<int, 2>& score_before) {
  const Json frame = {
      {"time", view.clock_ms / 1000.0},
      {"score", view.score},
      {"reset_reason", number_of(view.reset_reason, view.score[0] > score_before[0])},
      {"game_state", number_of(view.state)},
      {"ball_ownership", view.has_ball},
      {"half_passed", view.half == 2},
      {"subimages", Json::array()},
      {"coordinates",
       {robots_json(view.own),
        robots_json(view.opponents),
        {view.ball_m.x, view.ball_m.y, view.ball_height_m, nullptr, nullptr, nullptr}}},
      {"EOF", true},
  };
  return frame.dump();
}

}  // namespace striker::sil
