// SPDX-License-Identifier: Apache-2.0
#include "sil/match/league/league_report.hpp"

#include <gtest/gtest.h>

#include "tests/match/league/played_league.hpp"
#include "tests/match/record/scratch.hpp"

namespace striker::sil {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::istringstream stream(text);
  std::vector<std::string> parts;
  for (std::string part; std::getline(stream, part, at);) {
    parts.push_back(part);
  }
  return parts;
}

TEST(LeagueReport, MarkdownIsThisTable) {
  const std::vector<std::string> lines = split(league_markdown(league_table(small_league())), '\n');
  EXPECT_EQ(
      lines[0],
      "8 matches; 1 more were interrupted. Differences of goals a match, each two teams playing each seed twice "
      "with colours swapped: means with 95 % intervals over such pairs. Shares of wins with 95 % intervals.");
  EXPECT_EQ(lines[4], "| 1 | a | 6 | 2 | 2 | 2 | 10:7 | 0 | 8 | +0.50 +- 3.29 | 0.33 [0.10, 0.70] |");
  EXPECT_EQ(lines[6], "| 3 | c | 3 | 1 | 1 | 1 | 3:6 | 0 | 4 | +1.00 | 0.33 [0.06, 0.79] |");
  EXPECT_EQ(lines[10], "| a | b | 4 | 2 | 1 | 1 | 9:4 | 2 | +1.25 +- 3.18 | 0.50 [0.15, 0.85] |");
  EXPECT_EQ(lines[12], "| b | c | 1 | 1 | 0 | 0 | 5:0 | 0 | - | 1.00 [0.21, 1.00] |");
  EXPECT_EQ(lines[18], "| a | 1 | 0 | 0 | 1 | 2:3 | -1.00 |");
  EXPECT_EQ(lines[22], "| statistic | a | b | c |");
  EXPECT_EQ(lines[30], "| shots | 7 | - | - |");
}

TEST(LeagueReport, CsvHasACellForEachColumn) {
  const LeagueTable table = league_table(small_league());
  for (const std::string& csv : {league_csv(table), pairings_csv(table)}) {
    const std::vector<std::string> lines = split(csv, '\n');
    EXPECT_EQ(lines.size(), 4U);
    for (const std::string& line : lines) {
      EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(lines[0], ',')) << line;
    }
  }
  EXPECT_EQ(split(league_csv(table), '\n')[1].substr(0, 40), "1,a,6,2,2,2,10,7,0,8,3,0.5,3.28624,0.333");
  EXPECT_EQ(split(pairings_csv(table), '\n')[3], "b,c,1,1,0,0,5,0,0,,,1,0.206549,1");
}

TEST(LeagueReport, JsonHasTheSameFigures) {
  const nlohmann::ordered_json report = league_json(league_table(small_league()));
  EXPECT_EQ(report["record"], "striker league");
  EXPECT_EQ(report["incomplete"], 1);
  EXPECT_EQ(report["teams"][0]["team"], "a");
  EXPECT_EQ(report["teams"][0]["points"], 8);
  EXPECT_EQ(report["teams"][0]["figures"]["shots"], 7.0);
  EXPECT_EQ(report["teams"][1]["figures"]["shots"], nullptr);
  EXPECT_EQ(report["pairings"][0]["goal_difference"], 1.25);
  EXPECT_EQ(report["pairings"][2]["goal_difference"], nullptr);
  EXPECT_EQ(report["mirrors"][0]["goal_difference"], -1.0);
}

TEST(LeagueReport, FilesAreTheSameBytesInAnyOrderOfMatches) {
  const Scratch scratch;
  std::vector<MatchResult> results = small_league();
  write_league(league_table(results), scratch / "once");
  std::ranges::reverse(results);
  write_league(league_table(results), scratch / "again");
  for (const char* file : {"league.md", "league.csv", "pairings.csv", "league.json"}) {
    const std::string text = text_of(scratch / "once" / file);
    EXPECT_FALSE(text.empty()) << file;
    EXPECT_EQ(text, text_of(scratch / "again" / file)) << file;
  }
}

}  // namespace
}  // namespace striker::sil
