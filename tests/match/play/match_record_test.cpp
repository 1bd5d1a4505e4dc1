// SPDX-License-Identifier: Apache-2.0
// What a match tells its records of robots and buses, against what else is known of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sil/match/play/match_faults.hpp"
#include "tests/match/play/watched_match.hpp"

namespace striker::sil {
namespace {

struct Told final : MatchObserver {
  void begin(const MatchHeader& header) override { identities = header.identities; }
  void frame(const MatchFrame& frame) override {
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      lost[robot] += frame.robots[robot].lost_frames;
      if (frame.robots[robot].up > 0.9999 && !frame.ruling.sent_out[robot]) {
        const double error_m = std::abs(frame.robots[robot].height_m - (0.002 + 0.090) / 2.0);
        height_error_m = std::max(height_error_m, error_m);
        ++standing;
      }
    }
  }
  std::array<std::string, 2> identities;
  std::array<int, robots_in_match> lost = {};
  double height_error_m = 0.0;
  int standing = 0;
};

TEST(MatchRecord, WhoStandsIsAsHighAsItsBody) {
  Told told;
  ShortMatch match({.teams = {"rules", "rules"}, .seed = 3, .half_s = 5});
  match.play({&told}, {});
  EXPECT_GT(told.standing, 500);
  EXPECT_LT(told.height_error_m, 0.002);  // tyres and skids give
}

TEST(MatchRecord, OnlyTheBusThatLosesFramesIsSaidToLoseSome) {
  const MatchSetting setting = {.teams = {"rules", "rules"}, .seed = 3, .half_s = 5};
  Told sound;
  ShortMatch(setting).play({&sound}, {});
  for (const int lost : sound.lost) {
    EXPECT_EQ(lost, 0);
  }
  MatchPlan plan = plan_of(setting);
  add_faults(plan, R"([[case]]
name = "robot6"
[[case.fault]]
kind = "loss"
probability = 0.1
from_ms = 0
until_ms = 600000
)",
             "a plan");
  Told told;
  ShortMatch match(setting);
  match.play(plan, {&told}, {});
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    EXPECT_EQ(told.lost[robot] > 100, robot == 6) << robot << ": " << told.lost[robot];
  }
}

TEST(MatchRecord, ThePolicyOfATeamThatKicksIsNamed) {
  Told told;
  ShortMatch match({.teams = {"rules", "striker"}, .seed = 3, .half_s = 1});
  match.play({&told}, {});
  EXPECT_EQ(told.identities[0], "");
  EXPECT_EQ(told.identities[1].size(), 8U);
}

}  // namespace
}  // namespace striker::sil
