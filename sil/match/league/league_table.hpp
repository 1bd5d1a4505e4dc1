// SPDX-License-Identifier: Apache-2.0
// The table of a league from its matches: the same matches, in any order, give the same table.
//
// In a league each two teams play each seed twice, with colours swapped: a pair. What colour, kickoff and seed do to a
// match is alike for both of them within a pair, so that differences of goals are judged by pairs: the value of one is
// the mean of its two matches, and intervals are over pairs. A match whose counterpart is missing counts for points and
// goals, but is in no pair. Matches of a team against itself are a control: no points, and a mean of red minus blue that
// should be 0.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sil/match/league/intervals.hpp"
#include "sil/match/league/match_result.hpp"

namespace striker::sil {

struct LeagueRecord {
  int played = 0;
  int won = 0;
  int drawn = 0;
  int lost = 0;
  int goals_for = 0;  // the opponent's own goals too
  int goals_against = 0;

  [[nodiscard]] int points() const { return 3 * won + drawn; }

  bool operator==(const LeagueRecord&) const = default;
};

struct LeagueRow {
  std::string team;
  LeagueRecord record;
  int own_goals = 0;  // by the team
  int pairs = 0;
  Mean goal_difference;   // a match, over pairs
  Share win_share;        // of matches; a draw is no win
  LeagueFigures figures;  // means over the matches that have one
};

// As the first of the two sees it.
struct LeaguePairing {
  std::string first;  // stands higher in the table
  std::string second;
  LeagueRecord record;
  int pairs = 0;
  Mean goal_difference;
  Share win_share;
};

// A team against itself, as red sees it.
struct LeagueMirror {
  std::string team;
  LeagueRecord record;
  Mean goal_difference;  // a match, over matches
};

struct LeagueTable {
  std::vector<LeagueRow> rows;          // by points, goal difference a match, goals, name
  std::vector<LeaguePairing> pairings;  // by both teams' places
  std::vector<LeagueMirror> mirrors;    // by name
  int matches = 0;                      // that count
  int incomplete = 0;                   // that do not: they were interrupted
};

// Throws std::invalid_argument that names it if a match is there twice.
[[nodiscard]] LeagueTable league_table(std::span<const MatchResult> results);

}  // namespace striker::sil
