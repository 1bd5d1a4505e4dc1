// SPDX-License-Identifier: Apache-2.0
// What a match tells its records of robots and buses, against what else is known of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sil/match/play/match_faults.hpp"
#include "sil/match/record/statistics/match_statistics.hpp"
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

// What robot 3's statistics say with this fault from 1.5 s to 4 s, and whose controller had a fault of its policy.
struct Disturbed {
  double undriven_s = 0.0;
  RobotSet policy_corrupt;
};

Disturbed disturbed_by(const std::string& kind) {
  struct Figures final : MatchObserver {
    void frame(const MatchFrame& frame) override { statistics.add(frame); }
    MatchStatistics statistics;
  } figures;
  const MatchSetting setting = {.teams = {"rules", "striker"}, .half_s = 3};
  MatchPlan plan = plan_of(setting);
  add_faults(plan,
             "[[case]]\nname = \"robot3\"\n[[case.fault]]\nkind = \"" + kind +
                 "\"\nfrom_ms = 1500\nuntil_ms = 4000\n",
             "a plan");
  ShortMatch match(setting);
  match.play(plan, {&figures}, {});
  Disturbed disturbed;
  const auto& robots = figures.statistics.figures().robots;
  disturbed.undriven_s = robots[3].undriven_ms / 1e3;
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    disturbed.policy_corrupt[robot] =
        robots[robot].faults[static_cast<std::size_t>(core::Fault::policy_corrupt)] > 0;
  }
  return disturbed;
}

TEST(MatchRecord, ADeadOrUnheardControllerIsNotDriven) {
  for (const char* kind : {"brown_out", "interface_down", "bus_off", "loss", "stall"}) {
    EXPECT_GE(disturbed_by(kind).undriven_s, 1.9) << kind;  // the kickoff's lock is no play
  }
}

// All ten read the same weights; those of one are damaged for it alone.
TEST(MatchRecord, FlippedWeightsAreThatRobotsAlone) {
  EXPECT_EQ(disturbed_by("weight_flips").policy_corrupt, RobotSet().set(3));
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
