// SPDX-License-Identifier: Apache-2.0
// Plays a league: each two of its teams, each seed twice with colours swapped. A match is a pure function of its number,
// so that the table is the same with any number of processes, after any number of interruptions, and under mpirun
// (sil/scenario/runs/shared_runs.hpp).
//
// DIR/matches.jsonl holds a line a match (match_result.hpp), then league.md, league.csv, pairings.csv and league.json
// (league_report.hpp) the table of those that are there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sil/match/league/league_table.hpp"
#include "sil/match/play/match_setting.hpp"

namespace striker::sil {

struct LeaguePlan {
  std::vector<std::string> teams = {"rules", "random"};  // at least two, each once
  std::uint64_t pairs = 10;                              // of matches, for each two teams
  bool mirrors = false;                                  // each team against itself too, as a control
  MatchSetting match;                                    // seed: the first pair's
  int jobs = 1;
  std::filesystem::path directory;
};

// In the order in which they are played: all pairings of the first seed, then of the next.
[[nodiscard]] std::vector<MatchSetting> matches_of(const LeaguePlan& plan);

struct PlayedLeague {
  LeagueTable table;
  std::uint64_t played = 0;
  std::uint64_t matches = 0;
  bool reports = true;  // false in all but the first process of an mpirun
};

// Throws std::runtime_error with one line that names file, what is wrong, and the way out.
[[nodiscard]] PlayedLeague play_league(const LeaguePlan& plan, const std::function<bool()>& stop);

}  // namespace striker::sil
