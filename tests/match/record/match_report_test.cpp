// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/match_report.hpp"

#include <gtest/gtest.h>

#include "tests/match/record/scratch.hpp"

namespace striker::sil {
namespace {

using Json = nlohmann::ordered_json;

Json report_of_short_match(bool complete = true) {
  const Scratch scratch;
  MatchReport report(scratch / "match.json");
  RecordedMatch play({&report}, short_rules());
  play_short_match(play);
  play.finish(complete);
  return Json::parse(text_of(scratch / "match.json"));
}

TEST(MatchReport, TellsResultAndFlow) {
  const Json report = report_of_short_match();
  EXPECT_EQ(report["complete"], true);
  EXPECT_EQ(report["state_hash"], "0123456789abcdef");
  EXPECT_EQ(report["teams"], (Json::array({"rules", "striker"})));
  EXPECT_EQ(report["result"]["score"], (Json::array({1, 0})));
  EXPECT_EQ(report["result"]["winner"], "red");
  EXPECT_EQ(report["flow"]["played_s"], 20.0);
  const double sim_s = report["flow"]["sim_s"];
  EXPECT_EQ(report["flow"]["dead_s"], sim_s - 20.0);
  EXPECT_EQ(report["flow"]["frames"], sim_s * 20.0 + 1.0);
  EXPECT_EQ(report["flow"]["in_play_share"], 20.0 / sim_s);
  EXPECT_EQ(report["flow"]["half"], 2);
  EXPECT_EQ(report["flow"]["clock_s"], 10.0);
  const int deadlocks = report["flow"]["deadlocks"];
  EXPECT_GE(deadlocks, 1);
  EXPECT_EQ(report["flow"]["deadlocks_per_10_min"], deadlocks * 30.0);
}

TEST(MatchReport, TellsOfBothTeams) {
  const Json report = report_of_short_match();
  const Json& ours = report["red"];
  EXPECT_EQ(ours["name"], "rules");
  EXPECT_EQ(ours["goals"], 1);
  EXPECT_EQ(ours["attack"]["shots"], 1);
  EXPECT_EQ(ours["attack"]["shots_on_target"], 1);
  EXPECT_EQ(ours["attack"]["conversion"], 1.0);
  EXPECT_EQ(ours["discipline"]["fallen"], 1);
  EXPECT_EQ(ours["discipline"]["sent_out"], 1);
  EXPECT_EQ(ours["ball"]["touches"], 2);
  EXPECT_EQ(ours["firmware"]["order_age_mean_ms"], 20.0);
  EXPECT_EQ(ours["firmware"]["order_age_max_ms"], 20);
  EXPECT_EQ(report["blue"]["name"], "striker");
  EXPECT_EQ(report["blue"]["attack"]["conversion"], nullptr);  // of no shots
  EXPECT_EQ(report["blue"]["firmware"]["order_age_mean_ms"], nullptr);
  EXPECT_EQ(ours["corners"]["after_out"].get<int>() + report["blue"]["corners"]["after_out"].get<int>() +
                ours["goal_kicks"]["after_out"].get<int>() +
                report["blue"]["goal_kicks"]["after_out"].get<int>(),
            1);
  for (const char* share : {"possession_share", "control_share"}) {
    const Json& part = ours["ball"][share];
    if (!part.is_null()) {
      EXPECT_NEAR(part.get<double>() + report["blue"]["ball"][share].get<double>(), 1.0, 1e-12) << share;
    }
  }
}

TEST(MatchReport, TellsOfEachRobot) {
  const Json report = report_of_short_match();
  ASSERT_EQ(report["robots"].size(), 10U);
  EXPECT_EQ(report["robots"][7]["team"], "blue");
  EXPECT_EQ(report["robots"][7]["id"], 2);
  EXPECT_EQ(report["robots"][7]["touches"], 1);
  EXPECT_EQ(report["robots"][7]["faults"], Json::object());
}

TEST(MatchReport, AnInterruptedMatchHasNoWinner) {
  const Json report = report_of_short_match(false);
  EXPECT_EQ(report["complete"], false);
  EXPECT_EQ(report["result"]["score"], (Json::array({1, 0})));
  EXPECT_EQ(report["result"]["winner"], nullptr);
}

TEST(MatchReport, FaultsAreNamed) {
  const Scratch scratch;
  MatchReport report(scratch / "match.json");
  RecordedMatch play({&report});
  play.robots[6].fault = core::Fault::vision_lost;
  play.step();
  play.finish(false);
  const Json json = Json::parse(text_of(scratch / "match.json"));
  EXPECT_EQ(json["robots"][6]["faults"], (Json{{"vision_lost", 1}}));
  EXPECT_EQ(json["blue"]["firmware"]["faults"], 1);
  EXPECT_EQ(json["red"]["firmware"]["faults"], 0);
}

}  // namespace
}  // namespace striker::sil
