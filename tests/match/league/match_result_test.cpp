// SPDX-License-Identifier: Apache-2.0
#include "sil/match/league/match_result.hpp"

#include <gtest/gtest.h>

#include "sil/match/record/match_report.hpp"
#include "tests/match/league/played_league.hpp"
#include "tests/match/record/scratch.hpp"

namespace striker::sil {
namespace {

using Json = nlohmann::ordered_json;

void report_short_match(const std::filesystem::path& file, bool complete) {
  MatchReport report(file);
  RecordedMatch play({&report}, short_rules());
  play_short_match(play);
  play.finish(complete);
}

std::string refusal_of(const Json& report) {
  try {
    static_cast<void>(match_result(report, "out/match.json"));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "taken";
}

// Every column is one that match.json has.
TEST(MatchResult, IsReadFromAMatchsReport) {
  const Scratch scratch;
  report_short_match(scratch / "match.json", true);
  const MatchResult result = read_match_result(scratch / "match.json");
  EXPECT_EQ(result.teams, (std::array<std::string, 2>{"rules", "striker"}));
  EXPECT_EQ(result.seed, 7U);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.state_hash, "0123456789abcdef");
  EXPECT_EQ(result.goals, (std::array{1, 0}));
  EXPECT_EQ(figure_of(result.figures[0], "shots"), 1.0);
  EXPECT_EQ(figure_of(result.figures[0], "order_age_mean_ms"), 20.0);
  EXPECT_EQ(figure_of(result.figures[1], "order_age_mean_ms"), std::nullopt);
}

TEST(MatchResult, AnInterruptedOneSaysSo) {
  const Scratch scratch;
  report_short_match(scratch / "match.json", false);
  EXPECT_FALSE(read_match_result(scratch / "match.json").complete);
}

TEST(MatchResult, SurvivesJson) {
  const Scratch scratch;
  report_short_match(scratch / "match.json", true);
  const MatchResult result = read_match_result(scratch / "match.json");
  EXPECT_EQ(match_result(Json::parse(json_of(result).dump()), "a copy"), result);
}

TEST(MatchResult, NamesWhatIsMissingOrWrong) {
  const Json sound = json_of(played("a", "b", 1, 2, 0));
  EXPECT_EQ(refusal_of(sound), "taken");
  Json missing = sound;
  missing["blue"]["attack"].erase("shots");
  EXPECT_EQ(refusal_of(missing),
            "out/match.json: /blue/attack/shots is missing: a match.json of this version is needed");
  Json wrong = sound;
  wrong["seed"] = "one";
  EXPECT_EQ(refusal_of(wrong),
            "out/match.json: /seed is \"one\", which it cannot be: a match.json of this version is needed");
  Json no_score = sound;
  no_score["result"]["score"] = 3;
  EXPECT_NE(refusal_of(no_score), "taken");
}

TEST(MatchResult, NamesAFileThatIsNoJson) {
  const Scratch scratch;
  std::ofstream(scratch / "match.json") << "{\"complete\": tr";
  try {
    static_cast<void>(read_match_result(scratch / "match.json"));
    FAIL() << "it was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), (scratch / "match.json").string() + ": is not JSON: a match.json is needed");
  }
}

}  // namespace
}  // namespace striker::sil
