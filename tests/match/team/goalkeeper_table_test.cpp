// SPDX-License-Identifier: Apache-2.0
// Every row of the goalkeeper's table: its condition is the first that holds, and on its other side the next one is.
#include <gtest/gtest.h>

#include <numbers>

#include "sil/match/team/plane.hpp"
#include "sil/match/team/rules/roles.hpp"
#include "tests/match/team/expect_action.hpp"

namespace striker::sil {
namespace {

constexpr GoToGains quick = {1.4, 5.0, 0.4, false};
constexpr GoToGains full = {1.4, 5.0, 0.4, true};
constexpr GoToGains clearing = {1.4, 3.0, 0.8, true};

TEST(GoalkeeperTable, OutOfItsOwnGoal) {
  expect_action(goalkeeper_action({-3.91, 0.3, 0.0}, {-3.5, 0.0}), GoTo{{-3.775, 0.1}, quick});
  expect_action(goalkeeper_action({-3.91, -0.3, 0.0}, {-3.5, 0.0}), GoTo{{-3.775, -0.1}, quick});
  // Not yet: the ball is ahead in the area.
  expect_action(goalkeeper_action({-3.89, 0.3, 0.0}, {-3.5, 0.0}), GoTo{{-3.5, 0.0}, clearing});
}

TEST(GoalkeeperTable, HomeFromOutsideOfTheArea) {
  expect_action(goalkeeper_action({-2.99, 0.0, 0.0}, {-3.5, 0.2}), GoTo{{-3.775, 0.2}, full});
  expect_action(goalkeeper_action({-3.5, 0.91, 0.0}, {-3.5, -0.9}), GoTo{{-3.775, -0.425}, full});
  expect_action(goalkeeper_action({-3.5, -0.91, 0.0}, {-3.6, 0.9}), GoTo{{-3.775, 0.425}, full});
}

TEST(GoalkeeperTable, BehindABallBesideIt) {
  expect_action(goalkeeper_action({-3.3, 0.0, 0.0}, {-3.4, 0.31}), GoTo{{-3.55, 0.0}, quick});
  expect_action(goalkeeper_action({-3.3, 0.0, 0.0}, {-3.4, -0.31}), GoTo{{-3.55, 0.0}, quick});
}

TEST(GoalkeeperTable, GivesUpOnABallRightBehindIt) {
  expect_action(goalkeeper_action({-3.3, 0.0, 0.0}, {-3.31, 0.29}), TurnTo{std::numbers::pi / 2.0});
  expect_action(goalkeeper_action({-3.3, 0.0, 0.0}, {-3.8, -0.29}), TurnTo{std::numbers::pi / 2.0});
}

// The ball is ahead at 45 degrees.
TEST(GoalkeeperTable, HomeIfTheBallIsFarToItsLeft) {
  constexpr Vec2 ball = {-3.3, 0.2};
  expect_action(goalkeeper_action({-3.5, 0.0, radians(-15.1)}, ball), GoTo{{-3.775, 0.2}, quick});
  expect_action(goalkeeper_action({-3.5, 0.0, radians(-14.9)}, ball), GoTo{ball, clearing});
}

TEST(GoalkeeperTable, ClearsABallHoweverFarToItsRight) {
  expect_action(goalkeeper_action({-3.5, 0.0, radians(170.0)}, {-3.3, 0.0}), GoTo{{-3.3, 0.0}, clearing});
  expect_action(goalkeeper_action({-3.5, 0.0, 0.0}, {-3.5, -0.3}), GoTo{{-3.5, -0.3}, clearing});
}

TEST(GoalkeeperTable, FacesABallThatIsNearTheArea) {
  expect_action(goalkeeper_action({-3.775, 0.1, 0.0}, {-2.56, 0.29}),
                TurnTo{bearing_rad({-3.775, 0.1}, {-2.56, 0.29})});
  expect_action(goalkeeper_action({-3.775, 0.1, 0.0}, {-2.54, 0.29}), GoTo{{-3.775, 0.29}, full});  // too far
  expect_action(goalkeeper_action({-3.775, 0.1, 0.0}, {-2.56, 0.31}),
                GoTo{{-3.775, 0.31}, full});  // too far aside
  expect_action(goalkeeper_action({-3.3, 0.89, 0.0}, {-3.3, 1.08}),
                TurnTo{std::numbers::pi / 2.0});  // beside the area
}

TEST(GoalkeeperTable, ElseItFollowsTheBallBetweenThePosts) {
  expect_action(goalkeeper_action({-3.775, 0.0, 0.0}, {1.0, 0.3}), GoTo{{-3.775, 0.3}, full});
  expect_action(goalkeeper_action({-3.775, 0.0, 0.0}, {1.0, 2.0}), GoTo{{-3.775, 0.425}, full});
  expect_action(goalkeeper_action({-3.775, 0.0, 0.0}, {1.0, -2.0}), GoTo{{-3.775, -0.425}, full});
}

}  // namespace
}  // namespace striker::sil
