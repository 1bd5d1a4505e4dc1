// SPDX-License-Identifier: Apache-2.0
// The rule-based teams as a whole: set pieces, what they remember, passing.
#include "sil/match/team/rules/rules_team.hpp"

#include <gtest/gtest.h>

#include "sil/match/team/rules/roles.hpp"
#include "sil/match/team/top_speed.hpp"
#include "tests/match/team/expect_action.hpp"
#include "tests/match/team/views.hpp"

namespace striker::sil {
namespace {

SpeedOrder wheels(const TeamOrders& orders, std::size_t id) {
  return std::get<SpeedOrder>(orders[id].value());
}

SpeedOrder wheels_for(const Action& action, const Pose& robot, std::size_t id) {
  return wheels_of(action, robot, top_speed_m_s(id), ReverseSteering::corrected);
}

TeamView set_piece(GameState state, bool has_ball) {
  TeamView view = home_view();
  view.state = state;
  view.has_ball = has_ball;
  return view;
}

TEST(RulesTeam, AtAKickoffTheKickerGoesToTheCentre) {
  RulesTeam team({});
  const TeamView view = set_piece(GameState::kickoff, true);
  const TeamOrders orders = team.play(view);
  const Action expected = GoTo{{0.0, 0.0}, {1.4, 3.0, 0.4, false}};
  EXPECT_EQ(wheels(orders, kicker_id), wheels_for(expected, view.own[kicker_id].pose, kicker_id));
  EXPECT_EQ(wheels(orders, 3), SpeedOrder{});
}

TEST(RulesTeam, AtAGoalKickTheKeeperAndAtAPenaltyTheKickerDrivesAhead) {
  RulesTeam team({});
  EXPECT_EQ(wheels(team.play(set_piece(GameState::goal_kick, true)), goalkeeper_id), (SpeedOrder{1.8, 1.8}));
  const TeamOrders orders = team.play(set_piece(GameState::penalty, true));
  EXPECT_EQ(wheels(orders, kicker_id), (SpeedOrder{2.55, 2.55}));
  EXPECT_EQ(wheels(orders, goalkeeper_id), (SpeedOrder{1.8, 1.8}));  // again
}

TEST(RulesTeam, OtherwiseItsLastOrdersAreSaidAgain) {
  RulesTeam team({});
  TeamView view = home_view();
  view.ball_m = {-1.0, 0.7};
  const TeamOrders last = team.play(view);
  for (const GameState state : {GameState::kickoff, GameState::goal_kick, GameState::penalty}) {
    EXPECT_EQ(team.play(set_piece(state, false)), last);
  }
}

TEST(RulesTeam, ACornerIsPlayedByTheTables) {
  for (const bool has_ball : {false, true}) {
    RulesTeam team({.passing = true});
    TeamView view = set_piece(GameState::corner, has_ball);
    view.ball_m = {2.75, 1.5};
    const TeamOrders orders = team.play(view);
    const Sight sight = {.now = glimpse_of(view), .before = glimpse_of(view)};
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      EXPECT_EQ(wheels(orders, id), wheels_for(role_action(sight, id), view.own[id].pose, id));
    }
  }
}

// Robot 3 has a shoot chance and drives to where the ball will be in 2 frames.
TEST(RulesTeam, AfterAStopTheBallIsTakenToStandStill) {
  for (const bool stopped : {false, true}) {
    RulesTeam team({});
    TeamView view = home_view();
    view.own[3].pose = {1.0, 0.1, 0.5};
    view.ball_m = {2.0, 0.15};
    (void)team.play(view);
    view.ball_m = {2.0, 0.1};
    view.reset_reason = stopped ? ResetReason::deadlock : ResetReason::none;
    const Action expected = GoTo{{2.0, stopped ? 0.1 : 0.0}, {1.4, 5.0, 0.4, true}};
    const SpeedOrder is = wheels(team.play(view), 3);
    const SpeedOrder due = wheels_for(expected, view.own[3].pose, 3);
    EXPECT_NEAR(is.left_m_s, due.left_m_s, 1e-12);
    EXPECT_NEAR(is.right_m_s, due.right_m_s, 1e-12);
  }
}

TEST(RulesTeam, PublishedDiffersInReverseAlone) {
  RulesTeam corrected({});
  RulesTeam published({.reverse = ReverseSteering::published});
  TeamView view = home_view();
  view.ball_m = {-1.0, 0.7};
  view.own[1].pose = {-2.0, 0.5, 0.0};
  view.own[2].pose = {-2.0, -0.5, 3.0};  // the ball is behind it
  const TeamOrders first = corrected.play(view);
  const TeamOrders second = published.play(view);
  EXPECT_EQ(first[1], second[1]);
  EXPECT_NE(first[2], second[2]);
}

// Player A: robot 3 sends, robot 4 is free and receives.
struct Pass {
  Pass() {
    sight.now = glimpse_of(home_view());
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      sight.now.opponents[id] = {3.0, 2.0, 0.0};
    }
    sight.now.ball = {2.0, 0.1};
    sight.now.own[3] = {1.8, 0.1, 0.0};  // has a shoot chance
    sight.now.own[4] = {1.0, -1.0, 0.0};
    sight.before = sight.now;
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      sight.before.own[id].x_m -= 0.1;  // nobody is stuck
    }
  }
  auto play() { return team.play(sight, frame++); }

  PassingPlay team;
  Sight sight;
  int frame = 100;
};

TEST(Passing, ASenderThatMayShootDribblesAndItsReceiverIsFree) {
  Pass pass;
  const auto actions = pass.play();
  expect_action(actions[3].value(), GoTo{{2.0, 0.1}, {1.4, 5.0, 0.8, false}});
  EXPECT_FALSE(actions[4]);
  EXPECT_FALSE(actions[1]);
}

TEST(Passing, NobodySendsFarFromTheBall) {
  Pass pass;
  pass.sight.now.own[3] = {1.4, 0.1, 0.0};
  const auto actions = pass.play();
  for (const auto& action : actions) {
    EXPECT_FALSE(action);
  }
}

TEST(Passing, NobodyIsSentToWhoIsMarked) {
  Pass pass;
  for (const std::size_t id : {1U, 2U, 4U}) {
    pass.sight.now.opponents[id] = pass.sight.now.own[id];
    pass.sight.now.opponents[id].x_m += 0.49;
  }
  EXPECT_FALSE(pass.play()[3]);
  pass.sight.now.opponents[4].x_m += 0.02;
  EXPECT_TRUE(pass.play()[3]);
}

// Within 1.17 m of the goal it kicks, until it has touched the ball; then it stands.
TEST(Passing, AKickEndsWithATouch) {
  Pass pass;
  pass.sight.now.own[3] = {3.3, 0.1, 0.0};
  pass.sight.now.ball = {3.4, 0.1};
  pass.sight.before.ball = pass.sight.now.ball;
  expect_action(pass.play()[3].value(), GoTo{{3.4, 0.1}, {1.4, 5.0, 0.8, true}});
  pass.sight.now.touching[3] = true;
  expect_action(pass.play()[3].value(), GoTo{{3.4, 0.1}, {1.4, 5.0, 0.8, true}});
  pass.sight.now.touching[3] = false;
  expect_action(pass.play()[3].value(), Stand{});
}

// Without a shoot chance (it stands before the ball), facing it backwards.
TEST(Passing, ASenderWithoutAShotFacesTheBallAndDribbles) {
  Pass pass;
  pass.sight.now.own[3] = {2.2, 0.1, 0.5};
  expect_action(pass.play()[3].value(), GoTo{{2.0, 0.1}, {1.4, 5.0, 0.8, false}});
  pass.sight.now.own[3].heading_rad = 1.5;
  pass.sight.before.ball = {2.0, 0.0};
  expect_action(pass.play()[3].value(), GoTo{{2.0, 0.4}, {1.0, 3.0, 0.6, false}});
}

// The ball is 2.24 m off, comes nearer to the receiver and away from the goal.
TEST(Passing, AReceiverGoesToWhereTheBallComes) {
  Pass pass;
  pass.sight.now.own[3] = {2.2, 0.1, 1.5};  // faces nobody
  pass.sight.now.own[4] = {1.0, 2.1, 0.0};
  pass.sight.before.own[4] = {0.9, 2.1, 0.0};
  pass.sight.before.ball = {2.1, 0.2};
  const double frames = std::hypot(1.0, 2.0);
  expect_action(pass.play()[4].value(),
                GoTo{{2.0 - 0.1 * frames - 0.15, 0.1 - 0.1 * frames}, {1.0, 3.0, 0.6, false}});
}

TEST(Passing, WhoHasHardlyMovedInTheUpperHalfGoesToTheCentre) {
  Pass pass;
  pass.sight.before.own[1] = pass.sight.now.own[1];
  pass.sight.before.own[1].x_m += 0.002;
  pass.sight.before.own[2] = pass.sight.now.own[2];  // at y < 0
  const auto actions = pass.play();
  expect_action(actions[1].value(), GoTo{{0.0, 0.0}, {1.4, 3.5, 0.4, false}});
  EXPECT_FALSE(actions[2]);
  pass.sight.before.own[1].x_m += 0.001;
  EXPECT_FALSE(pass.play()[1]);
}

}  // namespace
}  // namespace striker::sil
