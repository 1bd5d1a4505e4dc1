// SPDX-License-Identifier: Apache-2.0
// Send-outs, returns, and robots that are put home.
#include <gtest/gtest.h>

#include "tests/match/played_match.hpp"

namespace striker::sil {
namespace {

TEST(RefereeRobots, OneThatLiesForThreeSecondsIsSentOut) {
  PlayedMatch match;
  match.open_play();
  match.frame.standing.reset(red(3));
  match.run(2950);
  EXPECT_EQ(match.count(EventKind::sent_out), 0U);
  match.frame.standing.set(red(3));  // stands again in the very frame
  match.step();
  EXPECT_EQ(match.last(EventKind::sent_out).cause, Cause::fallen);
  EXPECT_EQ(match.last(EventKind::sent_out).timer_ms, 3000);
  EXPECT_FALSE(match.ruling().may_move(red(3)));
  EXPECT_EQ(match.frame.robots[red(3)], slot(3));
}

TEST(RefereeRobots, OneThatStandsUpInTimeIsNot) {
  PlayedMatch match;
  match.open_play();
  match.frame.standing.reset(blue(1));
  match.run(2900);
  match.frame.standing.set(blue(1));
  match.step();
  match.frame.standing.reset(blue(1));
  match.run(2950);
  EXPECT_EQ(match.count(EventKind::sent_out), 0U);
}

TEST(RefereeRobots, OneThatLeavesTheFieldIsSentOut) {
  PlayedMatch match;
  match.open_play();
  match.put(blue(2), 4.36, 0.0);
  match.step();
  const MatchEvent event = match.last(EventKind::sent_out);
  EXPECT_EQ(event.cause, Cause::left_field);
  EXPECT_EQ(event.robot, blue(2));
  EXPECT_EQ(event.team, Team::blue);
  EXPECT_EQ(event.robot_placement, turned(slot(2)));
  EXPECT_EQ(match.frame.robots[blue(2)].x_m, 4.05);
}

TEST(RefereeRobots, WhoIsOutReturnsHomeAfterFiveSeconds) {
  PlayedMatch match;
  match.open_play();
  match.put(red(1), -5.0, 0.0);
  match.step();
  match.run(4950);
  EXPECT_TRUE(match.ruling().sent_out[red(1)]);
  match.step();
  EXPECT_FALSE(match.ruling().sent_out[red(1)]);
  EXPECT_TRUE(match.ruling().may_move(red(1)));
  EXPECT_EQ(match.frame.robots[red(1)], home_spot(1));
  EXPECT_EQ(match.last(EventKind::returned).timer_ms, 5000);
  match.run(10'000);
  EXPECT_EQ(match.count(EventKind::returned), 1U);
}

TEST(RefereeRobots, AReturnWaitsForAFreeSpot) {
  PlayedMatch match;
  match.open_play();
  match.put(red(1), -5.0, 0.0);
  match.step();
  match.put(blue(3), -2.25, 0.776);  // 0.224 m from its home
  match.run(7000);
  EXPECT_TRUE(match.ruling().sent_out[red(1)]);
  match.put(blue(3), -2.25, 0.774);
  match.step();
  EXPECT_FALSE(match.ruling().sent_out[red(1)]);
  EXPECT_EQ(match.last(EventKind::returned).timer_ms, 7050);
}

TEST(RefereeRobots, TheBallTakesASpotToo) {
  PlayedMatch match;
  match.open_play();
  match.put(red(1), -5.0, 0.0);
  match.ball(-2.25, 1.2);
  match.run(6000);
  EXPECT_TRUE(match.ruling().sent_out[red(1)]);
  match.ball(-2.25, 1.3);
  match.step();
  EXPECT_FALSE(match.ruling().sent_out[red(1)]);
}

TEST(RefereeRobots, AGoalBringsBackWhoIsOut) {
  PlayedMatch match;
  match.open_play();
  match.put(red(1), -5.0, 0.0);
  match.step();
  match.run(950);
  match.ball(4.0, 0.0);
  match.step();
  match.run_until_play();
  EXPECT_EQ(match.ruling().state, GameState::kickoff);
  EXPECT_TRUE(match.ruling().sent_out.none());
  EXPECT_EQ(match.frame.robots[red(1)], home_spot(1));
  match.ball(0.6, 0.0);
  match.run(10'000);
  EXPECT_EQ(match.count(EventKind::returned), 0U);  // its time is forgotten too
}

TEST(RefereeRobots, ADroppedBallBringsNobodyBack) {
  PlayedMatch match;
  match.open_play();
  match.ball(1.0, 0.0, 0.0);
  match.run(3900);
  match.put(red(1), -5.0, 0.0);
  match.run(100);
  ASSERT_EQ(match.ruling().state, GameState::pause);
  match.run_until_play();
  EXPECT_TRUE(match.ruling().sent_out[red(1)]);
}

TEST(RefereeRobots, AnAttackerInTheGoalAreaGoesHomeAndItsGoalkeeperOut) {
  PlayedMatch match;
  match.open_play();
  match.put(red(3), 3.6, 0.5);
  match.run(950);
  EXPECT_EQ(match.count(EventKind::sent_home), 0U);
  match.step();
  EXPECT_EQ(match.last(EventKind::sent_home).robot, red(3));
  EXPECT_EQ(match.last(EventKind::sent_home).cause, Cause::goal_area);
  EXPECT_EQ(match.last(EventKind::sent_home).timer_ms, 1000);
  EXPECT_EQ(match.frame.robots[red(3)], home_spot(3));
  EXPECT_TRUE(match.ruling().may_move(red(3)));
  EXPECT_EQ(match.last(EventKind::sent_out).robot, red(0));
  EXPECT_EQ(match.last(EventKind::sent_out).cause, Cause::goal_area);
  EXPECT_FALSE(match.ruling().may_move(red(0)));
  EXPECT_TRUE(match.ruling().may_move(blue(0)));
}

TEST(RefereeRobots, AGoalkeeperThatIsOutIsOutAnew) {
  PlayedMatch match;
  match.open_play();
  match.put(red(3), 3.6, 0.5);
  match.run(3000);
  match.put(red(2), 3.6, 0.5);
  match.run(1000);
  EXPECT_EQ(match.count(EventKind::sent_out), 1U);
  EXPECT_EQ(match.last(EventKind::out_anew).robot, red(0));
  match.run(4950);
  EXPECT_TRUE(match.ruling().sent_out[red(0)]);
  match.step();
  EXPECT_FALSE(match.ruling().sent_out[red(0)]);
}

TEST(RefereeRobots, AGoalkeeperInTheOpponentsGoalAreaGoesOutItself) {
  PlayedMatch match;
  match.open_play();
  match.put(blue(0), -3.6, 0.0);
  match.run(1000);
  EXPECT_EQ(match.count(EventKind::sent_home), 1U);
  EXPECT_TRUE(match.ruling().sent_out[blue(0)]);
  EXPECT_EQ(match.frame.robots[blue(0)], turned(slot(0)));
}

TEST(RefereeRobots, OneFrameOutOfTheGoalAreaStartsItsTimeAnew) {
  PlayedMatch match;
  match.open_play();
  match.put(blue(4), -3.6, 0.0);
  match.run(950);
  match.put(blue(4), -3.4, 0.0);
  match.step();
  match.put(blue(4), -3.6, 0.0);
  match.run(950);
  EXPECT_EQ(match.count(EventKind::sent_home), 0U);
  match.step();
  EXPECT_EQ(match.count(EventKind::sent_home), 1U);
}

TEST(RefereeRobots, AWayHomeWaitsForTheFirstFrameWithAFreeSpot) {
  PlayedMatch match;
  match.open_play();
  match.put(red(3), 3.6, 0.5);
  match.put(blue(1), -0.65, 0.5);
  match.run(2500);
  EXPECT_EQ(match.count(EventKind::sent_home), 0U);
  EXPECT_FALSE(match.ruling().sent_out[red(0)]);
  match.put(blue(1), -0.65, 0.6);
  match.step();
  EXPECT_EQ(match.count(EventKind::sent_home), 1U);
  EXPECT_EQ(match.last(EventKind::sent_home).timer_ms, 2550);
  EXPECT_TRUE(match.ruling().sent_out[red(0)]);
}

// Who takes the spot is sent out in the frame in which it would be free.
TEST(RefereeRobots, WhetherASpotIsFreeIsAskedOfTheFrameForBothColours) {
  for (const Team team : teams) {
    const auto at = [team](double x_m) { return team == Team::red ? x_m : -x_m; };
    PlayedMatch match;
    match.open_play();
    match.put(robot_of(opponent_of(team), 2), at(-0.65), at(0.3));
    match.frame.standing.reset(robot_of(opponent_of(team), 2));
    match.put(robot_of(team, 3), at(3.6), 0.0);
    match.run(3000);
    EXPECT_EQ(match.count(EventKind::sent_out), 1U);
    EXPECT_EQ(match.count(EventKind::sent_home), 0U);
    match.step();
    EXPECT_EQ(match.count(EventKind::sent_home), 1U);
  }
}

TEST(RefereeRobots, AGoalkeeperAwayForThreeSecondsGoesHome) {
  PlayedMatch match;
  match.open_play();
  match.step();  // seen at home: while it is locked, its time runs on
  match.put(blue(0), 2.9, 0.0);
  match.run(2950);
  EXPECT_EQ(match.count(EventKind::sent_home), 0U);
  match.step();
  EXPECT_EQ(match.last(EventKind::sent_home).cause, Cause::keeper_away);
  EXPECT_EQ(match.frame.robots[blue(0)], turned(home_spot(0)));
  EXPECT_TRUE(match.ruling().may_move(blue(0)));
}

TEST(RefereeRobots, AGoalkeeperThatIsOutIsNotAway) {
  PlayedMatch match;
  match.open_play();
  match.put(blue(0), 3.95, 0.7);
  match.step();
  match.run(4950);
  EXPECT_EQ(match.count(EventKind::sent_home), 0U);
  EXPECT_TRUE(match.ruling().sent_out[blue(0)]);
}

TEST(RefereeRobots, AGoalkeeperInItsGoalIsNotAway) {
  PlayedMatch match;
  match.open_play();
  match.put(blue(0), 4.2, 0.3);
  match.run(10'000);
  EXPECT_EQ(match.count(EventKind::sent_home), 0U);
}

// The kicker of a kickoff leaves the field in its first frame.
TEST(RefereeRobots, TheEndOfASetPieceFreesNobodyWhoIsOut) {
  PlayedMatch match;
  match.run_until_play();
  match.put(red(4), -5.0, 0.0);
  match.run(3000);
  ASSERT_EQ(match.ruling().state, GameState::open_play);
  EXPECT_FALSE(match.ruling().may_move(red(4)));
  match.run(2000);
  EXPECT_FALSE(match.ruling().may_move(red(4)));
  match.step();
  EXPECT_TRUE(match.ruling().may_move(red(4)));  // 5 s after it was sent out
  EXPECT_EQ(match.count(EventKind::sent_out), 1U);
}

TEST(RefereeRobots, AsPublishedTheEndOfASetPieceFreesItAndTheNextFrameSendsItOutAnew) {
  PlayedMatch match(published());
  match.run_until_play();
  match.ball(0.1, 0.0);
  match.put(red(4), -5.0, 0.0);
  match.run(3000);
  ASSERT_EQ(match.ruling().state, GameState::open_play);
  EXPECT_TRUE(match.ruling().may_move(red(4)));
  match.step();
  EXPECT_FALSE(match.ruling().may_move(red(4)));
  EXPECT_EQ(match.count(EventKind::sent_out), 2U);
  match.run(4950);
  EXPECT_FALSE(match.ruling().may_move(red(4)));
  match.step();
  EXPECT_TRUE(match.ruling().may_move(red(4)));
}

TEST(RefereeRobots, NobodyReturnsInASetPiece) {
  MatchRules rules = official();
  rules.set_piece_ms = 8000;
  PlayedMatch match(rules);
  match.run_until_play();
  match.put(red(4), -5.0, 0.0);
  match.run(8000);
  EXPECT_TRUE(match.ruling().sent_out[red(4)]);
  match.step();
  EXPECT_FALSE(match.ruling().sent_out[red(4)]);
}

TEST(RefereeRobots, ALockedOneIsNotJudgedButForTheGoalArea) {
  PlayedMatch match;
  match.run_until_play();
  match.put(blue(1), 5.0, 0.0);
  match.put(blue(0), 0.0, 2.0);
  match.frame.standing.reset(blue(2));
  match.put(red(3), 3.6, 0.0);
  match.run(2950);
  EXPECT_FALSE(match.ruling().sent_out[blue(1)]);
  EXPECT_FALSE(match.ruling().sent_out[blue(2)]);
  EXPECT_EQ(match.count(EventKind::sent_home), 1U);
  EXPECT_TRUE(match.ruling().sent_out[red(0)]);
  EXPECT_FALSE(match.ruling().may_move(red(3)));  // at home, and locked still
  match.run(100);
  EXPECT_TRUE(match.ruling().sent_out[blue(1)]);
  EXPECT_TRUE(match.ruling().sent_out[blue(2)]);
}

}  // namespace
}  // namespace striker::sil
