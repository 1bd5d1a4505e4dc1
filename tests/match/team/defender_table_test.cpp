// SPDX-License-Identifier: Apache-2.0
// Every row of the defenders' table: its condition is the first that holds, and on its other side the next one is.
#include <gtest/gtest.h>

#include "sil/match/team/rules/roles.hpp"
#include "tests/match/team/expect_action.hpp"

namespace striker::sil {
namespace {

constexpr GoToGains driving = {1.4, 5.0, 0.4, true};
constexpr GoToGains turning = {1.4, 3.5, 0.6, false};
constexpr GoToGains placing = {1.4, 3.5, 0.4, false};

TEST(DefenderTable, OutOfItsOwnGoal) {
  for (const bool is_nearest : {false, true}) {
    expect_action(defender_action({-3.91, 0.3}, {-1.0, 0.0}, is_nearest), GoTo{{-2.73, 0.1}, turning});
    expect_action(defender_action({-3.91, -0.3}, {-1.0, 0.0}, is_nearest), GoTo{{-2.73, -0.1}, turning});
  }
  expect_action(defender_action({-3.89, 0.3}, {-1.0, 2.0}, true), GoTo{{-1.0, 2.0}, driving});
}

// Straight ahead the line meets the goal.
TEST(DefenderTable, TheNearestShootsIfItHasAChance) {
  expect_action(defender_action({0.5, 0.0}, {1.16, 0.0}, true), GoTo{{1.16, 0.0}, driving});
  expect_action(defender_action({0.5, 0.0}, {1.18, 0.0}, true),
                GoTo{{-2.73, 0.0}, placing});  // too far ahead
  expect_action(defender_action({0.5, 0.6}, {1.16, 0.6}, true), GoTo{{-2.73, 0.6}, placing});  // no chance
  expect_action(defender_action({0.5, 0.0}, {1.16, 0.0}, false), GoTo{{-2.73, -0.5}, placing});
  // A line that is not straight: (3.9 - 1) / 0.5 times 0.11, from the robot's y of -0.2: 0.438.
  expect_action(defender_action({0.5, -0.2}, {1.0, -0.09}, true), GoTo{{1.0, -0.09}, driving});
  expect_action(defender_action({0.5, 0.0}, {1.0, 0.1}, true), GoTo{{-2.73, 0.1}, placing});
}

TEST(DefenderTable, TheNearestPushesABallAhead) {
  expect_action(defender_action({-1.05, 1.0}, {-1.0, 2.0}, true), GoTo{{-1.0, 2.0}, driving});
  expect_action(defender_action({-1.03, 1.0}, {-1.0, 2.0}, true),
                GoTo{{-1.5, 2.0}, turning});  // hardly ahead
  expect_action(defender_action({-1.05, 1.0}, {0.01, 2.0}, true),
                GoTo{{-2.73, 2.0}, placing});  // beyond the middle
}

TEST(DefenderTable, TheNearestGoesRoundBehind) {
  expect_action(defender_action({-0.5, 1.0}, {-1.0, 1.31}, true), GoTo{{-1.5, 1.31}, turning});
  expect_action(defender_action({-0.5, 1.0}, {-1.0, 1.29}, true), GoTo{{-1.5, 1.0}, turning});
  expect_action(defender_action({-0.5, 1.0}, {-3.5, 0.0}, true),
                GoTo{{-3.825, 0.0}, turning});  // before the end line
}

TEST(DefenderTable, TheNearestWaitsForABallBeyondTheMiddle) {
  expect_action(defender_action({1.0, 0.0}, {0.0, -1.5}, true), GoTo{{-2.73, -1.5}, placing});
}

TEST(DefenderTable, TheOtherOneCoversTheGoal) {
  expect_action(defender_action({-0.5, 1.0}, {-1.0, 0.64}, false), GoTo{{-1.5, 0.64}, placing});
  expect_action(defender_action({-0.5, 1.0}, {-1.0, 2.0}, false), GoTo{{-1.5, 0.65}, placing});
  expect_action(defender_action({-0.5, 1.0}, {-1.0, -2.0}, false), GoTo{{-1.5, -0.65}, placing});
  expect_action(defender_action({-0.5, 1.0}, {-3.5, 0.0}, false), GoTo{{-3.725, 0.0}, placing});
}

TEST(DefenderTable, TheOtherOneWaitsToTheMiddleOfTheBall) {
  expect_action(defender_action({-0.5, 1.0}, {0.0, 1.0}, false), GoTo{{-2.73, 0.5}, placing});
  expect_action(defender_action({-0.5, 1.0}, {0.0, -1.0}, false), GoTo{{-2.73, -0.5}, placing});
  expect_action(defender_action({-0.5, 1.0}, {0.0, 0.0}, false),
                GoTo{{-2.73, -0.5}, placing});  // 0 counts as left
}

}  // namespace
}  // namespace striker::sil
