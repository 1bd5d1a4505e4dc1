// SPDX-License-Identifier: Apache-2.0
// A league's table (league_table.hpp) as files: the same table, the same bytes.
//
//   league.md      for a reader: the table, pairings, mirror matches, statistics
//   league.csv     a row a team: place, team, played, won, drawn, lost, goals_for, goals_against, own_goals, points,
//                  pairs, goal_difference, goal_difference_half_width, win_share, win_share_low, win_share_high, then
//                  the columns of match_result.hpp. Empty: there is none.
//   pairings.csv   a row a pairing, as its first sees it: first, second, played, won, drawn, lost, goals_for,
//                  goals_against, pairs, goal_difference, goal_difference_half_width, win_share, ..._low, ..._high
//   league.json    record ("striker league"), format (1), matches, incomplete; teams, pairings and mirrors with the
//                  same keys, statistics of teams under "figures"; version, git_hash and build_type of the program
//
// Half-widths and bounds are of 95 % intervals: Student's t over pairs for goal differences, Wilson's for shares of
// wins. Goal differences are a match.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "sil/match/league/league_table.hpp"

namespace striker::sil {

[[nodiscard]] std::string league_markdown(const LeagueTable& table);
[[nodiscard]] std::string league_csv(const LeagueTable& table);
[[nodiscard]] std::string pairings_csv(const LeagueTable& table);
[[nodiscard]] nlohmann::ordered_json league_json(const LeagueTable& table);

// All four, in this directory, which is made if it is missing. Throws std::runtime_error that names the file.
void write_league(const LeagueTable& table, const std::filesystem::path& directory);

}  // namespace striker::sil
