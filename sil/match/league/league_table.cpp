// SPDX-License-Identifier: Apache-2.0
#include "sil/match/league/league_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

namespace striker::sil {
namespace {

bool is_mirror(const MatchResult& match) {
  return match.teams[0] == match.teams[1];
}

// Red's side of it, or blue's.
void count(LeagueRecord& record, const MatchResult& match, std::size_t side) {
  const int own = match.goals[side];
  const int other = match.goals[1 - side];
  ++record.played;
  record.won += own > other ? 1 : 0;
  record.drawn += own == other ? 1 : 0;
  record.lost += own < other ? 1 : 0;
  record.goals_for += own;
  record.goals_against += other;
}

int difference(const MatchResult& match, std::size_t side) {
  return match.goals[side] - match.goals[1 - side];
}

// Those that count, in an order of their own.
std::vector<MatchResult> complete_matches(std::span<const MatchResult> results) {
  std::vector<MatchResult> matches;
  std::ranges::copy_if(results, std::back_inserter(matches), &MatchResult::complete);
  const auto key = [](const MatchResult& match) { return std::tie(match.teams, match.seed); };
  std::ranges::sort(matches, {}, key);
  const auto twice = std::ranges::adjacent_find(matches, {}, key);
  if (twice != matches.end()) {
    throw std::invalid_argument(
        fmt::format("{} against {} with seed {} is there twice: each match counts once", twice->teams[0],
                    twice->teams[1], twice->seed));
  }
  return matches;
}

// Of the matches of `team` against `other`, or against all others: the means of goal differences of whole pairs.
std::vector<double> pair_differences(const std::vector<MatchResult>& matches, const std::string& team,
                                     const std::string* other) {
  std::map<std::pair<std::string, std::uint64_t>, std::vector<int>> pairs;  // by opponent and seed
  for (const MatchResult& match : matches) {
    for (const std::size_t side : {0U, 1U}) {
      const std::string& opponent = match.teams[1 - side];
      if (!is_mirror(match) && match.teams[side] == team && (other == nullptr || *other == opponent)) {
        pairs[{opponent, match.seed}].push_back(difference(match, side));
      }
    }
  }
  std::vector<double> means;
  for (const auto& [key, differences] : pairs) {
    if (differences.size() == 2) {
      means.push_back((differences[0] + differences[1]) / 2.0);
    }
  }
  return means;
}

LeagueFigures mean_figures(const std::vector<const LeagueFigures*>& figures) {
  LeagueFigures means;
  for (std::size_t column = 0; column < means.size(); ++column) {
    std::vector<double> values;
    for (const LeagueFigures* match : figures) {
      if ((*match)[column]) {
        values.push_back(*(*match)[column]);
      }
    }
    if (!values.empty()) {
      means[column] = mean_of(values).value;
    }
  }
  return means;
}

LeagueRow row_of(const std::string& team, const std::vector<MatchResult>& matches) {
  LeagueRow row;
  row.team = team;
  std::vector<const LeagueFigures*> figures;
  for (const MatchResult& match : matches) {
    for (const std::size_t side : {0U, 1U}) {
      if (!is_mirror(match) && match.teams[side] == team) {
        count(row.record, match, side);
        row.own_goals += match.own_goals[side];
        figures.push_back(&match.figures[side]);
      }
    }
  }
  const std::vector<double> differences = pair_differences(matches, team, nullptr);
  row.pairs = static_cast<int>(differences.size());
  row.goal_difference = mean_of(differences);
  row.win_share = share_of(row.record.won, row.record.played);
  row.figures = mean_figures(figures);
  return row;
}

LeaguePairing pairing_of(const std::string& first, const std::string& second,
                         const std::vector<MatchResult>& matches) {
  LeaguePairing pairing;
  pairing.first = first;
  pairing.second = second;
  for (const MatchResult& match : matches) {
    for (const std::size_t side : {0U, 1U}) {
      if (match.teams[side] == first && match.teams[1 - side] == second) {
        count(pairing.record, match, side);
      }
    }
  }
  const std::vector<double> differences = pair_differences(matches, first, &second);
  pairing.pairs = static_cast<int>(differences.size());
  pairing.goal_difference = mean_of(differences);
  pairing.win_share = share_of(pairing.record.won, pairing.record.played);
  return pairing;
}

LeagueMirror mirror_of(const std::string& team, const std::vector<MatchResult>& matches) {
  LeagueMirror mirror;
  mirror.team = team;
  std::vector<double> differences;
  for (const MatchResult& match : matches) {
    if (is_mirror(match) && match.teams[0] == team) {
      count(mirror.record, match, 0);
      differences.push_back(difference(match, 0));
    }
  }
  mirror.goal_difference = mean_of(differences);
  return mirror;
}

// By goals a match, since not all teams need to have played as often.
auto place(const LeagueRow& row) {
  const double played = std::max(row.record.played, 1);
  return std::tuple(-row.record.points(), (row.record.goals_against - row.record.goals_for) / played,
                    -row.record.goals_for, row.team);
}

}  // namespace

LeagueTable league_table(std::span<const MatchResult> results) {
  const std::vector<MatchResult> matches = complete_matches(results);
  LeagueTable table;
  table.matches = static_cast<int>(matches.size());
  table.incomplete = static_cast<int>(results.size() - matches.size());
  std::set<std::string> names;
  std::set<std::string> mirrored;
  for (const MatchResult& match : matches) {
    if (is_mirror(match)) {
      mirrored.insert(match.teams[0]);
    } else {
      names.insert(match.teams.begin(), match.teams.end());
    }
  }
  for (const std::string& name : names) {
    table.rows.push_back(row_of(name, matches));
  }
  std::ranges::sort(table.rows, {}, place);
  for (std::size_t first = 0; first < table.rows.size(); ++first) {
    for (std::size_t second = first + 1; second < table.rows.size(); ++second) {
      LeaguePairing pairing = pairing_of(table.rows[first].team, table.rows[second].team, matches);
      if (pairing.record.played > 0) {
        table.pairings.push_back(std::move(pairing));
      }
    }
  }
  for (const std::string& name : mirrored) {
    table.mirrors.push_back(mirror_of(name, matches));
  }
  return table;
}

}  // namespace striker::sil
