// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/match_json.hpp"

#include "sil/match/referee/areas.hpp"
#include "sil/world/physics_constants.hpp"

namespace striker::sil {
namespace {

nlohmann::ordered_json geometry_json() {
  return {{"field_half_length_m", field_half_length_m},
          {"field_half_width_m", field_half_width_m},
          {"goal_half_width_m", goal_half_width_m},
          {"goal_back_m", goal_back_m},
          {"corner_leg_m", corner_leg_m},
          {"penalty_line_m", penalty_line_m},
          {"penalty_half_width_m", penalty_half_width_m},
          {"goal_area_line_m", goal_area_line_m},
          {"goal_area_half_width_m", goal_area_half_width_m},
          {"wall_thickness_m", wall_thickness_m},
          {"ball_radius_m", ball_radius_m},
          {"robot_side_m", robot_side_m},
          {"robot_top_m", robot_top_m}};
}

nlohmann::ordered_json physics_json() {
  return {{"gravity_m_s2", gravity_m_s2},
          {"ball_mass_kg", ball_mass_kg},
          {"kept_after_1_s", kept_after_1_s},
          {"tyre_friction", tyre_friction}};
}

}  // namespace

nlohmann::ordered_json rules_json(const MatchRules& rules) {
  return {{"half_ms", rules.half_ms},
          {"goal_pause_ms", rules.goal_pause_ms},
          {"stop_pause_ms", rules.stop_pause_ms},
          {"half_pause_ms", rules.half_pause_ms},
          {"settle_ms", rules.settle_ms},
          {"set_piece_ms", rules.set_piece_ms},
          {"fallen_ms", rules.fallen_ms},
          {"sent_out_ms", rules.sent_out_ms},
          {"goal_area_ms", rules.goal_area_ms},
          {"keeper_away_ms", rules.keeper_away_ms},
          {"deadlock_ms", rules.deadlock_ms},
          {"slow_ball_m_s", rules.slow_ball_m_s},
          {"kickoff_ball_m", rules.kickoff_ball_m},
          {"clearance_m", rules.clearance_m},
          {"most_defenders", rules.most_defenders},
          {"most_attackers", rules.most_attackers},
          {"deadlock", rules.deadlock},
          {"own_flag_for_sent_out", rules.own_flag_for_sent_out},
          {"drop_on_free_spot", rules.drop_on_free_spot}};
}

nlohmann::ordered_json header_json(const MatchHeader& header) {
  nlohmann::ordered_json identities = nlohmann::ordered_json::array();
  for (const std::string& identity : header.identities) {
    identities.push_back(identity.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(identity));
  }
  return {{"teams", header.teams},
          {"identities", identities},
          {"seed", header.seed},
          {"plant", header.plant},
          {"slip", header.slip},
          {"jitter_m", header.jitter_m},
          {"jitter_rad", header.jitter_rad},
          {"faults", header.faults},
          {"rule_set", header.rule_set},
          {"rules", rules_json(header.rules)},
          {"geometry", geometry_json()},
          {"physics", physics_json()}};
}

nlohmann::ordered_json json_of(Vec2 spot) {
  return nlohmann::ordered_json::array({spot.x + 0.0, spot.y + 0.0});  // never -0
}

nlohmann::ordered_json json_of(const Pose& pose) {
  return nlohmann::ordered_json::array({pose.x_m + 0.0, pose.y_m + 0.0, pose.heading_rad + 0.0});
}

}  // namespace striker::sil
