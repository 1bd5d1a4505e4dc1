// SPDX-License-Identifier: Apache-2.0
// What a league needs of a match: a part of its match.json (sil/match/record/match_report.hpp), under the same keys, so
// that a league that was interrupted goes on from the reports of the matches that were played.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace striker::sil {

// A statistic of a team, as a league's table has it: the mean over its matches.
struct LeagueColumn {
  std::string_view name;
  std::string_view pointer;  // within the team's part of match.json
};

inline constexpr std::array league_columns = {
    LeagueColumn{"possession_share", "/ball/possession_share"},
    LeagueColumn{"control_share", "/ball/control_share"},
    LeagueColumn{"attacking_third_share", "/ball/attacking_third_share"},
    LeagueColumn{"touches", "/ball/touches"},
    LeagueColumn{"passes", "/ball/passes"},
    LeagueColumn{"penalty_area_entries", "/ball/penalty_area_entries"},
    LeagueColumn{"shots", "/attack/shots"},
    LeagueColumn{"shots_on_target", "/attack/shots_on_target"},
    LeagueColumn{"conversion", "/attack/conversion"},
    LeagueColumn{"kicks", "/attack/kicks"},
    LeagueColumn{"kicks_met", "/attack/kicks_met"},
    LeagueColumn{"kicks_as_meant_share", "/attack/kicks_as_meant_share"},
    LeagueColumn{"saves", "/keeper/saves"},
    LeagueColumn{"keeper_line_m", "/keeper/line_m"},
    LeagueColumn{"keeper_lag_m", "/keeper/lag_m"},
    LeagueColumn{"goal_kicks_after_out", "/goal_kicks/after_out"},
    LeagueColumn{"goal_kicks_after_crowding", "/goal_kicks/after_crowding"},
    LeagueColumn{"goal_kicks_after_deadlock", "/goal_kicks/after_deadlock"},
    LeagueColumn{"corners_after_out", "/corners/after_out"},
    LeagueColumn{"corners_after_deadlock", "/corners/after_deadlock"},
    LeagueColumn{"penalties_after_crowding", "/penalties/after_crowding"},
    LeagueColumn{"penalties_after_deadlock", "/penalties/after_deadlock"},
    LeagueColumn{"sent_out", "/discipline/sent_out"},
    LeagueColumn{"fallen", "/discipline/fallen"},
    LeagueColumn{"left_field", "/discipline/left_field"},
    LeagueColumn{"keeper_sent_out", "/discipline/keeper_sent_out"},
    LeagueColumn{"sent_home", "/discipline/sent_home"},
    LeagueColumn{"keeper_sent_home", "/discipline/keeper_sent_home"},
    LeagueColumn{"out_s", "/discipline/out_s"},
    LeagueColumn{"order_age_mean_ms", "/firmware/order_age_mean_ms"},
    LeagueColumn{"order_age_max_ms", "/firmware/order_age_max_ms"},
    LeagueColumn{"saturation_share", "/firmware/saturation_share"},
    LeagueColumn{"lost_frames", "/firmware/lost_frames"},
    LeagueColumn{"faults", "/firmware/faults"},
    LeagueColumn{"undriven_s", "/firmware/undriven_s"}};

// None where there is nothing to take a share or mean of.
using LeagueFigures = std::array<std::optional<double>, league_columns.size()>;

// Pairs are red's and blue's.
struct MatchResult {
  std::array<std::string, 2> teams;
  std::uint64_t seed = 1;
  bool complete = false;
  std::string state_hash;
  std::array<int, 2> goals = {};
  std::array<int, 2> own_goals = {};  // by these, for their opponents
  std::array<LeagueFigures, 2> figures = {};

  bool operator==(const MatchResult&) const = default;
};

// `source` is what errors name. Throws std::runtime_error that names it, the field and what is wrong with it: a value of
// another type, or one that no match has, such as -9 goals, a share of 1.5, half a shot, own goals that are not among
// the opponent's goals, or a state that is not 16 hexadecimal digits.
[[nodiscard]] MatchResult match_result(const nlohmann::ordered_json& report, std::string_view source);
[[nodiscard]] MatchResult read_match_result(const std::filesystem::path& match_json);

// The part of match.json that match_result takes.
[[nodiscard]] nlohmann::ordered_json json_of(const MatchResult& result);

}  // namespace striker::sil
