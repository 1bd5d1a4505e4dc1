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

TEST(MatchResult, WhatNoMatchHasIsRefused) {
  MatchResult one = played("a", "b", 1, 2, 1);
  for (auto& figures : one.figures) {
    for (std::size_t column = 0; column < league_columns.size(); ++column) {
      figures[column] = 1.0;
    }
  }
  const Json sound = json_of(one);
  EXPECT_EQ(refusal_of(sound), "taken");
  const auto refused = [&](const std::string& pointer, const Json& value) {
    Json wrong = sound;
    wrong[Json::json_pointer(pointer)] = value;
    const std::string refusal = refusal_of(wrong);
    EXPECT_NE(refusal.find("out/match.json: " + pointer), std::string::npos) << value << ": " << refusal;
  };
  for (const Json& value : {Json(-9), Json(9.7), Json(true), Json("2"), Json(), Json(2'000'000)}) {
    refused("/result/score/0", value);
    refused("/blue/own_goals", value);
  }
  refused("/result/score", Json::array({2, 1, 0}));
  refused("/teams", Json::array({"a", "b", "c"}));
  refused("/red/own_goals", 2);  // blue has one goal
  refused("/seed", 1.0);
  refused("/complete", 1);
  for (const char* hash : {"Z123456789abcdef", "0123456789ABCDEF", "0123456789abcde", ""}) {
    refused("/state_hash", hash);
  }
  for (const LeagueColumn& column : league_columns) {
    const std::string pointer = "/red" + std::string(column.pointer);
    for (const Json& value : {Json(-1), Json("1"), Json(true)}) {
      refused(pointer, value);
    }
  }
  refused("/red/ball/possession_share", 1.01);
  refused("/red/attack/conversion", 1.01);
  refused("/red/attack/shots", 0.5);
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
