// SPDX-License-Identifier: Apache-2.0
// Results of matches by hand.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sil/match/league/match_result.hpp"

namespace striker::sil {

inline MatchResult played(const std::string& red, const std::string& blue, std::uint64_t seed, int red_goals,
                          int blue_goals) {
  MatchResult result;
  result.teams = {red, blue};
  result.seed = seed;
  result.complete = true;
  result.state_hash = "0123456789abcdef";
  result.goals = {red_goals, blue_goals};
  return result;
}

// Of the column of that name.
inline std::optional<double>& figure_of(LeagueFigures& figures, std::string_view name) {
  for (std::size_t column = 0; column < league_columns.size(); ++column) {
    if (league_columns[column].name == name) {
      return figures[column];
    }
  }
  throw std::out_of_range(std::string(name));
}
inline std::optional<double> figure_of(const LeagueFigures& figures, std::string_view name) {
  LeagueFigures copy = figures;
  return figure_of(copy, name);
}

// Two pairs of a against b, one of a against c, half a pair of b against c, a mirror match, and one that was
// interrupted.
inline std::vector<MatchResult> small_league() {
  std::vector<MatchResult> results = {
      played("a", "b", 1, 3, 1), played("b", "a", 1, 2, 2), played("a", "b", 2, 0, 1),
      played("b", "a", 2, 0, 4), played("a", "c", 1, 1, 1), played("c", "a", 1, 2, 0),
      played("b", "c", 1, 5, 0), played("a", "a", 1, 2, 3), played("c", "b", 1, 9, 0)};
  results.back().complete = false;
  results[0].own_goals = {0, 1};
  figure_of(results[0].figures[0], "shots") = 8.0;
  figure_of(results[1].figures[1], "shots") = 6.0;
  figure_of(results[0].figures[0], "conversion") = 0.25;
  return results;
}

}  // namespace striker::sil
