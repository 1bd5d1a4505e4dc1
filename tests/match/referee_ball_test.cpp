// SPDX-License-Identifier: Apache-2.0
// Goals, outs, crowds and deadlocks.
#include <gtest/gtest.h>

#include "tests/match/played_match.hpp"

namespace striker::sil {
namespace {

// A frame with the ball there.
void ball_at(PlayedMatch& match, double x_m, double y_m, double speed_m_s = 1.0) {
  match.ball(x_m, y_m, speed_m_s);
  match.step();
}

// Out by the keepers' own spots, where they stay for 5 s: both penalty areas are empty.
void empty_penalty_areas(PlayedMatch& match) {
  match.put(red(0), -3.95, 0.7);
  match.put(blue(0), 3.95, 0.7);
  match.step();
  ASSERT_EQ(match.count(EventKind::sent_out), 2U);
}

TEST(Referee, AGoalNeedsTheCentreBetweenThePostsAndAStripBesideThemIsDead) {
  PlayedMatch match;
  match.open_play();
  ball_at(match, 3.91, 0.51);
  EXPECT_EQ(match.ruling().state, GameState::open_play);
  PlayedMatch out = match;
  ball_at(match, 3.91, 0.49);
  EXPECT_EQ(match.ruling().score, (std::array{1, 0}));
  EXPECT_EQ(match.last(EventKind::goal).team, Team::red);
  ball_at(out, 3.93, 0.53);
  EXPECT_EQ(out.ruling().score, (std::array{0, 0}));
  EXPECT_EQ(out.last(EventKind::ball_out).cause, Cause::end_line);
}

TEST(Referee, WhoConcedesKicksOff) {
  for (const double end : {-1.0, 1.0}) {
    PlayedMatch match;
    match.open_play();
    ball_at(match, end * 4.0, 0.0);
    match.run_until_play();
    EXPECT_EQ(match.ruling().owner, end < 0 ? Team::red : Team::blue);
    EXPECT_EQ(match.ruling().state, GameState::kickoff);
    EXPECT_EQ(match.ruling().reset_reason, end < 0 ? ResetReason::blue_scored : ResetReason::red_scored);
    EXPECT_EQ(match.frame.ball.position_m, (Vec2{0.0, 0.0}));
    EXPECT_EQ(match.frame.ball.height_m, 0.06);
  }
}

TEST(Referee, AnOwnGoalWasTouchedLastByTheConcedingTeamAlone) {
  const auto cause = [](std::initializer_list<std::size_t> touching) {
    PlayedMatch match;
    match.open_play();
    for (const std::size_t robot : touching) {
      match.touch(robot);
    }
    ball_at(match, -3.5, 0.0);
    ball_at(match, -4.0, 0.0);
    EXPECT_EQ(match.ruling().score, (std::array{0, 1}));
    return match.last(EventKind::goal).cause;
  };
  EXPECT_EQ(cause({red(0)}), Cause::own_goal);
  EXPECT_EQ(cause({red(0), red(2)}), Cause::own_goal);
  EXPECT_EQ(cause({red(0), blue(4)}), Cause::scored);
  EXPECT_EQ(cause({blue(4)}), Cause::scored);
  EXPECT_EQ(cause({}), Cause::scored);
}

TEST(Referee, AnOutAfterATouchOfBothIsTheAttackersCorner) {
  PlayedMatch match;
  match.open_play();
  match.touch(red(1));
  match.touch(blue(3));
  ball_at(match, -3.5, 1.0);
  ball_at(match, -3.95, 1.0);
  EXPECT_EQ(match.last(EventKind::ball_out).counts, (std::array{1, 1}));
  match.run_until_play();
  EXPECT_EQ(match.ruling().state, GameState::corner);
  EXPECT_EQ(match.ruling().owner, Team::blue);
}

TEST(Referee, AnOutThatNobodyTouchedIsTheAttackersCorner) {
  PlayedMatch match;
  match.open_play();
  ball_at(match, 3.95, -1.0);
  EXPECT_EQ(match.last(EventKind::ball_out).counts, (std::array{0, 0}));
  match.run_until_play();
  EXPECT_EQ(match.ruling().state, GameState::corner);
  EXPECT_EQ(match.ruling().owner, Team::red);
  EXPECT_EQ(match.frame.ball.position_m, (Vec2{2.75, -1.5}));
}

TEST(Referee, AKickoffForgetsTheLastTouch) {
  PlayedMatch match;
  match.open_play();
  match.touch(red(4));
  ball_at(match, 4.0, 0.0);
  match.open_play();
  ball_at(match, 3.95, -1.0);
  EXPECT_EQ(match.last(EventKind::ball_out).counts, (std::array{0, 0}));
  EXPECT_EQ(match.last(EventKind::ball_out).team, Team::red);
}

TEST(Referee, AnOutIsOfTheTeamThatTouchedLess) {
  PlayedMatch match;
  match.open_play();
  match.touch(red(1));
  match.touch(red(2));
  match.touch(blue(3));
  ball_at(match, 1.0, 0.0);
  ball_at(match, 1.0, 2.36);  // over a side line, in blue's half
  EXPECT_EQ(match.last(EventKind::ball_out).cause, Cause::side_line);
  match.run_until_play();
  EXPECT_EQ(match.ruling().state, GameState::goal_kick);
  EXPECT_EQ(match.ruling().owner, Team::blue);
}

TEST(Referee, ALaterTouchReplacesTheOneBefore) {
  PlayedMatch match;
  match.open_play();
  match.touch(red(1));
  ball_at(match, 1.0, 0.0);
  match.touch(blue(3));
  ball_at(match, 1.0, 0.0);
  ball_at(match, 3.95, 1.0);
  EXPECT_EQ(match.last(EventKind::ball_out).last_touch, RobotSet().set(blue(3)));
  EXPECT_EQ(match.last(EventKind::ball_out).team, Team::red);
}

TEST(Referee, AFourthDefenderGivesAPenaltyInTheSameFrame) {
  PlayedMatch match;
  match.open_play();
  match.put(red(1), -3.5, 0.3);
  match.put(red(2), -3.5, -0.3);
  match.put(red(3), -3.0, 0.5);
  ball_at(match, -3.0, 0.0);
  EXPECT_EQ(match.ruling().state, GameState::open_play);
  match.put(red(3), -3.001, 0.5);
  match.step();
  EXPECT_EQ(match.last(EventKind::crowding).cause, Cause::defenders);
  EXPECT_EQ(match.last(EventKind::crowding).counts, (std::array{4, 0}));
  match.run_until_play();
  EXPECT_EQ(match.ruling().state, GameState::penalty);
  EXPECT_EQ(match.ruling().owner, Team::blue);
}

TEST(Referee, DefendersAreCountedBeforeAttackers) {
  PlayedMatch match;
  match.open_play();
  for (std::size_t id = 1; id < 4; ++id) {
    match.put(red(id), -3.3, 0.25 * static_cast<double>(id));
    match.put(blue(id), -3.3, -0.25 * static_cast<double>(id));
  }
  ball_at(match, -3.2, 0.0);
  EXPECT_EQ(match.last(EventKind::crowding).cause, Cause::defenders);
  EXPECT_EQ(match.last(EventKind::crowding).set_piece, GameState::penalty);
}

TEST(Referee, AThirdAttackerGivesAGoalKick) {
  PlayedMatch match;
  match.open_play();
  match.put(red(1), 3.2, 0.3);
  match.put(red(2), 3.2, -0.3);
  ball_at(match, 3.1, 0.0);
  EXPECT_EQ(match.ruling().state, GameState::open_play);
  match.put(red(4), 3.2, 0.6);
  match.step();
  EXPECT_EQ(match.last(EventKind::crowding).cause, Cause::attackers);
  EXPECT_EQ(match.last(EventKind::crowding).counts, (std::array{3, 1}));
  match.run_until_play();
  EXPECT_EQ(match.ruling().state, GameState::goal_kick);
  EXPECT_EQ(match.ruling().owner, Team::blue);
}

TEST(Referee, WhoIsOutDoesNotCrowd) {
  PlayedMatch match;
  match.open_play();
  empty_penalty_areas(match);
  for (const std::size_t id : {1U, 2U, 3U}) {
    match.put(red(id), -3.3, 0.25 * static_cast<double>(id));
  }
  ball_at(match, -3.2, 0.0);
  EXPECT_EQ(match.count(EventKind::crowding), 0U);
}

TEST(Referee, ASlowBallInAnEmptyPenaltyAreaIsAPenaltyAfterFourSeconds) {
  PlayedMatch slow;
  slow.open_play();
  empty_penalty_areas(slow);
  PlayedMatch fast = slow;
  slow.ball(3.5, 0.3, 0.39);
  slow.run(3950);
  EXPECT_EQ(slow.count(EventKind::deadlock), 0U);
  slow.step();
  const MatchEvent event = slow.last(EventKind::deadlock);
  EXPECT_EQ(event.cause, Cause::penalty_area);
  EXPECT_EQ(event.timer_ms, 4000);
  EXPECT_EQ(event.counts, (std::array{0, 0}));
  slow.run_until_play();
  EXPECT_EQ(slow.ruling().state, GameState::penalty);
  EXPECT_EQ(slow.ruling().owner, Team::red);

  fast.ball(3.5, 0.3, 0.40);
  fast.run(4900);
  EXPECT_EQ(fast.count(EventKind::deadlock), 0U);
}

TEST(Referee, AFastFrameStartsTheDeadlocksTimeAnew) {
  PlayedMatch match;
  match.open_play();
  match.ball(1.0, 0.0, 0.0);
  match.run(3950);
  ball_at(match, 1.0, 0.0, 0.4);
  match.ball(1.0, 0.0, 0.0);
  match.run(3950);
  EXPECT_EQ(match.count(EventKind::deadlock), 0U);
  match.step();
  EXPECT_EQ(match.count(EventKind::deadlock), 1U);
}

TEST(Referee, ASlowBallInAPenaltyAreaIsOfWhoHasMoreRobotsThere) {
  PlayedMatch match;
  match.open_play();
  match.ball(-3.4, 0.3, 0.0);
  match.run(4000);
  EXPECT_EQ(match.last(EventKind::deadlock).counts, (std::array{1, 0}));  // the goalkeeper
  match.run_until_play();
  EXPECT_EQ(match.ruling().state, GameState::goal_kick);
  EXPECT_EQ(match.ruling().owner, Team::red);
}

TEST(Referee, ADeadlockWithAsManyThereIsOfWhoIsNearerAndInDoubtTheAttackers) {
  const auto event = [](double x_m, double y_m) {
    PlayedMatch match;
    match.open_play();
    match.put(blue(4), x_m, y_m);
    match.ball(-3.4, 0.3, 0.0);  // red's goalkeeper is 0.5 m from it
    match.run(4000);
    return match.last(EventKind::deadlock);
  };
  EXPECT_EQ(event(-3.3, 0.3).team, Team::blue);
  EXPECT_EQ(event(-3.3, 0.3).set_piece, GameState::penalty);
  EXPECT_EQ(event(-3.3, 0.3).counts, (std::array{1, 1}));
  EXPECT_NEAR(event(-3.3, 0.3).distances_m[0], 0.5, 1e-9);
  EXPECT_NEAR(event(-3.3, 0.3).distances_m[1], 0.1, 1e-9);
  EXPECT_EQ(event(-3.1, -0.4).team, Team::red);
  EXPECT_EQ(event(-3.1, -0.4).set_piece, GameState::goal_kick);

  PlayedMatch match;
  match.open_play();
  match.put(red(0), -3.4, 0.4);
  match.put(blue(4), -3.4, -0.4);
  match.ball(-3.4, 0.0, 0.0);
  match.run(4000);
  EXPECT_EQ(match.last(EventKind::deadlock).team, Team::blue);
}

TEST(Referee, ADeadlockInACornerIsACornerKickForEitherTeam) {
  for (const Team team : teams) {
    PlayedMatch match;
    match.open_play();
    match.put(robot_of(team, 3), -3.5, -1.9);
    match.put(robot_of(opponent_of(team), 3), -3.5, 1.9);    // the other corner
    match.put(robot_of(opponent_of(team), 2), -2.99, -1.9);  // not far enough
    match.ball(-3.8, -2.2, 0.0);
    match.run(4000);
    EXPECT_EQ(match.last(EventKind::deadlock).cause, Cause::corner_area);
    match.run_until_play();
    EXPECT_EQ(match.ruling().state, GameState::corner);
    EXPECT_EQ(match.ruling().owner, team);
    EXPECT_EQ(match.frame.ball.position_m, (Vec2{-2.75, -1.5}));
    EXPECT_EQ(match.ruling().reset_reason, ResetReason::corner_kick);
  }
}

TEST(Referee, ADroppedBallKeepsItsLastTouch) {
  PlayedMatch match;
  match.open_play();
  match.touch(red(4));
  ball_at(match, 1.0, 0.0, 0.0);
  match.run(3950);
  ASSERT_EQ(match.last(EventKind::deadlock).cause, Cause::elsewhere);
  match.run_until_play();
  ball_at(match, 3.95, 1.0);
  EXPECT_EQ(match.last(EventKind::ball_out).counts, (std::array{1, 0}));
  EXPECT_EQ(match.last(EventKind::ball_out).team, Team::blue);
  EXPECT_EQ(match.last(EventKind::ball_out).set_piece, GameState::goal_kick);
}

TEST(Referee, ABallIsDroppedInItsQuadrantAndOnNobody) {
  for (const Vec2 quadrant : {Vec2{1, 1}, Vec2{1, -1}, Vec2{-1, 1}, Vec2{-1, -1}}) {
    const Vec2 spot = {1.5 * quadrant.x, quadrant.y};
    for (const bool is_official : {true, false}) {
      PlayedMatch match(is_official ? official() : published());
      match.open_play();
      match.put(red(3), spot.x, spot.y);
      match.ball(quadrant.x, 0.1 * quadrant.y, 0.0);
      match.run(5000);
      ASSERT_TRUE(match.ruling().placements.ball);
      const MatchEvent event = match.last(EventKind::restart);
      EXPECT_EQ(event.cause, Cause::drop);
      EXPECT_EQ(event.spot_was_taken, is_official);
      EXPECT_EQ(event.ball_placement, match.ruling().placements.ball);
      // +x of the team whose end it is: to the other end.
      const double moved_m = is_official ? -0.23 * quadrant.x : 0.0;
      EXPECT_NEAR(match.frame.ball.position_m.x, spot.x + moved_m, 1e-9);
      EXPECT_NEAR(match.frame.ball.position_m.y, spot.y, 1e-9);
    }
  }
}

TEST(Referee, WithoutTheDeadlockRuleASlowBallStays) {
  MatchRules rules = official();
  rules.deadlock = false;
  PlayedMatch match(rules);
  match.open_play();
  match.ball(1.0, 0.0, 0.0);
  match.run(60'000);
  EXPECT_EQ(match.ruling().state, GameState::open_play);
}

}  // namespace
}  // namespace striker::sil
