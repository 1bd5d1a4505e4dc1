// SPDX-License-Identifier: Apache-2.0
#include "sil/match/league/league_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/match/league/played_league.hpp"

namespace striker::sil {
namespace {

const LeagueRow& row_of(const LeagueTable& table, const std::string& team) {
  const auto row = std::ranges::find(table.rows, team, &LeagueRow::team);
  if (row == table.rows.end()) {
    throw std::out_of_range(team);
  }
  return *row;
}

TEST(LeagueTable, CountsPointsAndGoals) {
  const LeagueTable table = league_table(small_league());
  EXPECT_EQ(table.matches, 8);
  EXPECT_EQ(table.incomplete, 1);
  const LeagueRow& a = row_of(table, "a");
  EXPECT_EQ(
      a.record,
      (LeagueRecord{.played = 6, .won = 2, .drawn = 2, .lost = 2, .goals_for = 10, .goals_against = 7}));
  EXPECT_EQ(a.record.points(), 8);
  EXPECT_EQ(a.own_goals, 0);
  EXPECT_EQ(row_of(table, "b").own_goals, 1);
  EXPECT_EQ(row_of(table, "b").record.points(), 7);
  EXPECT_EQ(row_of(table, "c").record.points(), 4);
  EXPECT_NEAR(a.win_share.value, 2.0 / 6.0, 1e-12);
}

TEST(LeagueTable, StandsByPointsThenDifferenceThenName) {
  const LeagueTable table = league_table(small_league());
  EXPECT_EQ(table.rows[0].team, "a");
  EXPECT_EQ(table.rows[1].team, "b");
  EXPECT_EQ(table.rows[2].team, "c");
  const LeagueTable level = league_table(std::vector{played("z", "y", 1, 1, 1), played("x", "w", 1, 2, 2),
                                                     played("v", "u", 1, 4, 1), played("t", "s", 1, 3, 1)});
  std::string order;
  for (const LeagueRow& row : level.rows) {
    order += row.team;
  }
  EXPECT_EQ(order, "vtwxyzsu");
}

// 1: (3 - 1 + 2 - 2) / 2 = 1; 2: (0 - 1 + 4 - 0) / 2 = 1.5. Against c: (1 - 1 + 0 - 2) / 2 = -1.
TEST(LeagueTable, JudgesDifferencesByPairs) {
  const LeagueTable table = league_table(small_league());
  ASSERT_EQ(table.pairings.size(), 3U);
  EXPECT_EQ(table.pairings[0].first, "a");
  EXPECT_EQ(table.pairings[0].second, "b");
  EXPECT_EQ(table.pairings[0].pairs, 2);
  EXPECT_NEAR(table.pairings[0].goal_difference.value, 1.25, 1e-12);
  EXPECT_NEAR(table.pairings[0].goal_difference.half_width.value(), 12.7062 * 0.25, 1e-4);
  EXPECT_EQ(row_of(table, "a").pairs, 3);
  EXPECT_NEAR(row_of(table, "a").goal_difference.value, 0.5, 1e-12);
  EXPECT_NEAR(row_of(table, "b").goal_difference.value, -1.25, 1e-12);
  EXPECT_EQ(table.pairings[2].pairs, 0);  // b against c: half a pair
  EXPECT_EQ(table.pairings[2].record.played, 1);
  EXPECT_FALSE(table.pairings[2].goal_difference.half_width);
}

TEST(LeagueTable, KeepsMirrorMatchesApart) {
  const LeagueTable table = league_table(small_league());
  ASSERT_EQ(table.mirrors.size(), 1U);
  EXPECT_EQ(table.mirrors[0].team, "a");
  EXPECT_EQ(table.mirrors[0].record.played, 1);
  EXPECT_EQ(table.mirrors[0].record.lost, 1);
  EXPECT_EQ(table.mirrors[0].goal_difference.value, -1.0);
}

TEST(LeagueTable, MeansAreOverMatchesThatHaveAFigure) {
  const LeagueTable table = league_table(small_league());
  EXPECT_EQ(figure_of(row_of(table, "a").figures, "shots"), 7.0);
  EXPECT_EQ(figure_of(row_of(table, "a").figures, "conversion"), 0.25);
  EXPECT_EQ(figure_of(row_of(table, "b").figures, "shots"), std::nullopt);
}

TEST(LeagueTable, RefusesAMatchTwice) {
  std::vector<MatchResult> results = small_league();
  results.push_back(results[3]);
  try {
    static_cast<void>(league_table(results));
    FAIL() << "it was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "b against a with seed 2 is there twice: each match counts once");
  }
}

TEST(LeagueTable, OfNothingIsEmpty) {
  const LeagueTable table = league_table({});
  EXPECT_TRUE(table.rows.empty());
  EXPECT_EQ(table.matches, 0);
}

// Over a whole league nothing is won that nobody loses, whatever the results and their order.
TEST(LeagueTable, SumsVanish) {
  std::mt19937 random(7);
  const std::vector<std::string> names = {"a", "b", "c", "d"};
  std::vector<MatchResult> results;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const std::string& red : names) {
      for (const std::string& blue : names) {
        if (red != blue) {
          results.push_back(
              played(red, blue, seed, static_cast<int>(random() % 5), static_cast<int>(random() % 5)));
        }
      }
    }
  }
  const LeagueTable table = league_table(results);
  LeagueRecord sum;
  double differences = 0.0;
  for (const LeagueRow& row : table.rows) {
    sum.played += row.record.played;
    sum.won += row.record.won;
    sum.drawn += row.record.drawn;
    sum.lost += row.record.lost;
    sum.goals_for += row.record.goals_for;
    sum.goals_against += row.record.goals_against;
    differences += row.goal_difference.value;
    EXPECT_EQ(row.pairs, 60);
    EXPECT_NEAR(row.goal_difference.value,
                (row.record.goals_for - row.record.goals_against) / static_cast<double>(row.record.played),
                1e-9);
    EXPECT_LT(row.win_share.low, row.win_share.value);
    EXPECT_GT(row.win_share.high, row.win_share.value);
  }
  EXPECT_EQ(sum.played, 2 * table.matches);
  EXPECT_EQ(sum.won, sum.lost);
  EXPECT_EQ(sum.drawn % 2, 0);
  EXPECT_EQ(sum.goals_for, sum.goals_against);
  EXPECT_NEAR(differences, 0.0, 1e-9);

  std::shuffle(results.begin(), results.end(), random);
  const LeagueTable again = league_table(results);
  for (std::size_t place = 0; place < table.rows.size(); ++place) {
    EXPECT_EQ(again.rows[place].team, table.rows[place].team);
    EXPECT_EQ(again.rows[place].goal_difference.value, table.rows[place].goal_difference.value);
    EXPECT_EQ(again.rows[place].goal_difference.half_width, table.rows[place].goal_difference.half_width);
  }
}

}  // namespace
}  // namespace striker::sil
