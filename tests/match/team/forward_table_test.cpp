// SPDX-License-Identifier: Apache-2.0
// Every row of the forwards' table: its condition is the first that holds, and on its other side the next one is.
#include <gtest/gtest.h>

#include "sil/match/team/plane.hpp"
#include "sil/match/team/rules/roles.hpp"
#include "tests/match/team/expect_action.hpp"

namespace striker::sil {
namespace {

constexpr GoToGains driving = {1.4, 5.0, 0.4, true};
constexpr GoToGains leaving = {1.4, 3.0, 0.8, false};
constexpr GoToGains turning = {1.4, 3.5, 0.6, false};
constexpr GoToGains placing = {1.4, 3.5, 0.4, false};

// Robot 3 of a team; the ball has moved by `move` since the last frame.
Sight sight(Vec2 robot, Vec2 ball, Vec2 move = {}) {
  Sight result;
  result.now.own[3] = {robot.x, robot.y, 0.0};
  result.now.ball = ball;
  result.before = result.now;
  result.before.ball = {ball.x - move.x, ball.y - move.y};
  return result;
}

void expect_nearest(const Sight& sees, const Action& expected) {
  expect_action(forward_action(sees, 3, true), expected);
}
void expect_other(const Sight& sees, const Action& expected) {
  expect_action(forward_action(sees, 3, false), expected);
}

TEST(ForwardTable, OutOfTheBallsWay) {
  expect_nearest(sight({0.2, 1.0}, {0.0, 1.2}), GoTo{{-0.05, 0.45}, leaving});
  expect_other(sight({0.2, 1.0}, {0.0, 1.2}), GoTo{{-0.05, 0.45}, leaving});
  expect_nearest(sight({0.2, -1.0}, {0.0, -1.2}), GoTo{{-0.05, -0.45}, leaving});
  // Not far enough ahead, too far aside, too near to either goal.
  expect_nearest(sight({0.09, 1.0}, {0.0, 1.2}), GoTo{{-0.2, 1.0}, turning});
  expect_nearest(sight({0.2, 1.0}, {0.0, 1.31}), GoTo{{-0.2, 1.31}, turning});
  expect_nearest(sight({1.4, 1.0}, {1.18, 1.2}), GoTo{{0.98, 1.0}, turning});
  expect_nearest(sight({-1.0, 1.0}, {-1.18, 1.2}), GoTo{{-0.39, 1.2}, placing});
}

TEST(ForwardTable, TheNearestShootsAtWhereTheBallWillBe) {
  expect_nearest(sight({1.0, 0.1}, {2.0, 0.1}, {0.03, -0.01}), GoTo{{2.06, 0.08}, driving});
  expect_nearest(sight({-3.0, 0.1}, {-2.0, 0.1}), GoTo{{-2.0, 0.1}, driving});  // from anywhere
  expect_other(sight({1.0, 0.1}, {2.0, 0.1}), GoTo{{1.75, -0.5}, placing});
}

// The ball comes down from the left and crosses the robot's y at x = 2.2, in 4 frames.
TEST(ForwardTable, TheNearestTurnsToTheGoalForABallThatWillCross) {
  const auto crossing = [](double robot_x, double frames) {
    const double fall = 0.4 / frames;
    return sight({robot_x, 1.0}, {2.2, 1.4}, {-1e-6, -fall});
  };
  expect_nearest(crossing(2.0, 4.0), TurnTo{bearing_rad({2.0, 1.0}, {3.9, 0.0})});
  expect_nearest(crossing(2.0, 9.9), TurnTo{bearing_rad({2.0, 1.0}, {3.9, 0.0})});
  expect_nearest(crossing(2.0, 10.1), GoTo{{2.2, 1.4}, driving});                          // too late
  expect_nearest(crossing(2.101, 4.0), GoTo{{2.2, 1.4}, driving});                         // too near
  expect_nearest(crossing(1.899, 4.0), GoTo{{2.2, 1.4}, driving});                         // too far
  expect_nearest(sight({2.0, 1.0}, {2.2, 1.4}, {-1e-6, 0.0}), GoTo{{2.2, 1.4}, driving});  // crosses nowhere
  expect_nearest(sight({2.0, 1.0}, {2.2, 1.4}, {1e-6, -0.1}),
                 GoTo{{2.2, 1.4}, driving});  // in x it goes away
  expect_nearest(sight({2.0, 1.0}, {2.2, 1.4}, {-1e-6, 0.1}),
                 GoTo{{2.2, 1.4}, driving});  // in y it goes away
}

TEST(ForwardTable, TheNearestPushesABallAhead) {
  expect_nearest(sight({0.95, 1.0}, {1.0, 2.0}), GoTo{{1.0, 2.0}, driving});
  expect_nearest(sight({0.97, 1.0}, {1.0, 2.0}), GoTo{{0.8, 2.0}, turning});
  expect_nearest(sight({-1.5, 1.0}, {-1.16, 2.0}), GoTo{{-1.16, 2.0}, driving});
}

TEST(ForwardTable, TheNearestGoesRoundBehind) {
  expect_nearest(sight({1.5, 1.0}, {1.2, 1.31}), GoTo{{1.0, 1.31}, turning});
  expect_nearest(sight({1.5, 1.0}, {1.2, 1.29}), GoTo{{1.0, 1.0}, turning});
}

TEST(ForwardTable, TheNearestWaitsInTheMiddle) {
  expect_nearest(sight({-2.0, 1.0}, {-1.18, 2.0}), GoTo{{-0.39, 2.0}, placing});
}

TEST(ForwardTable, TheOtherOneFollowsOnTheOtherSide) {
  expect_other(sight({-2.0, 1.0}, {-1.16, 2.0}), GoTo{{-1.41, -0.5}, placing});
  expect_other(sight({-2.0, 1.0}, {1.0, -2.0}), GoTo{{0.75, 0.5}, placing});
  expect_other(sight({-2.0, 1.0}, {1.0, 0.0}), GoTo{{0.75, -0.5}, placing});  // 0 counts as left
}

TEST(ForwardTable, TheOtherOneWaitsOnTheOtherSide) {
  expect_other(sight({-2.0, 1.0}, {-1.18, 1.0}), GoTo{{-0.39, -0.5}, placing});
  expect_other(sight({-2.0, 1.0}, {-1.18, -1.0}), GoTo{{-0.39, 0.5}, placing});
  expect_other(sight({-2.0, 1.0}, {-1.18, 2.3}), GoTo{{-0.39, -1.8}, placing});
}

TEST(RoleAction, TheNearestOfEachPairIsTheOneThatActs) {
  Sight sees;
  for (std::size_t id = 1; id < robots_a_team; ++id) {
    sees.now.own[id] = {-3.0, id % 2 == 0 ? -1.0 : 1.0, 0.0};
  }
  sees.now.ball = {-1.0, 1.5};
  sees.before = sees.now;
  expect_action(role_action(sees, 0), goalkeeper_action(sees.now.own[0], sees.now.ball));
  expect_action(role_action(sees, 1), GoTo{sees.now.ball, driving});
  expect_action(role_action(sees, 2), GoTo{{-1.5, 0.65}, placing});
  expect_action(role_action(sees, 3), GoTo{sees.now.ball, driving});
  expect_action(role_action(sees, 4), GoTo{{-1.25, -0.5}, placing});
  sees.now.ball.y = 0.0;  // as near: the lower id
  EXPECT_EQ(nearest_defender(sees.now), 1U);
  EXPECT_EQ(nearest_forward(sees.now), 3U);
  sees.now.ball.y = -1e-6;
  EXPECT_EQ(nearest_defender(sees.now), 2U);
  EXPECT_EQ(nearest_forward(sees.now), 4U);
}

}  // namespace
}  // namespace striker::sil
