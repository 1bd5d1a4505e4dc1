// SPDX-License-Identifier: Apache-2.0
// Shots and saves, as match_figures.hpp has them.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/match/record/recorded_match.hpp"

namespace striker::sil {
namespace {

struct Opened : RecordedMatch {
  Opened() { open_play(); }

  // A touch by this robot, after which the ball is there and rolls like that.
  void shoot(std::size_t robot, Vec2 from, Vec2 velocity_m_s) {
    ball(from.x, from.y, velocity_m_s);
    touched_by({robot});
  }
  int shots(Team team) const { return figures(team).shots; }
  int on_target(Team team) const { return figures(team).shots_on_target; }
  int saves(Team team) const { return figures(team).saves; }
};

TEST(Shot, IsOnTargetWhenItMeetsTheGoal) {
  Opened play;
  play.shoot(red(3), {2.4, 0.0}, {2.0, 0.6});  // crosses at 0.45
  EXPECT_EQ(play.shots(Team::red), 1);
  EXPECT_EQ(play.on_target(Team::red), 1);
  EXPECT_EQ(play.shots(Team::blue), 0);
}

TEST(Shot, IsWideBesideThePost) {
  Opened play;
  play.shoot(red(3), {2.4, 0.0}, {2.0, 0.8});  // crosses at 0.60
  EXPECT_EQ(play.shots(Team::red), 1);
  EXPECT_EQ(play.on_target(Team::red), 0);
}

TEST(Shot, IsNoneFarBesideTheGoal) {
  Opened play;
  play.shoot(red(3), {2.4, 0.0}, {2.0, 1.0});  // crosses at 0.75
  EXPECT_EQ(play.shots(Team::red), 0);
}

TEST(Shot, IsNoneOfASlowBall) {
  Opened play;
  play.shoot(red(3), {3.4, 0.0}, {1.0, 0.0});
  EXPECT_EQ(play.shots(Team::red), 0);
  play.shoot(red(3), {3.4, 0.0}, {1.01, 0.0});
  EXPECT_EQ(play.shots(Team::red), 1);
}

// A ball of 2 m/s rolls 3.227 m in 2 s: 2 (1 - 0.64) / 0.22314.
TEST(Shot, ReachesTheLineInTwoSecondsOfRoll) {
  Opened near;
  near.shoot(red(3), {3.9 - 3.22, 0.0}, {2.0, 0.0});
  EXPECT_EQ(near.shots(Team::red), 1);
  Opened far;
  far.shoot(red(3), {3.9 - 3.24, 0.0}, {2.0, 0.0});
  EXPECT_EQ(far.shots(Team::red), 0);
}

TEST(Shot, IsNoneAtTheOwnGoal) {
  Opened play;
  play.shoot(red(3), {-2.4, 0.0}, {-2.0, 0.0});
  EXPECT_EQ(play.shots(Team::red) + play.shots(Team::blue), 0);
}

TEST(Shot, IsNoneWithoutATouch) {
  Opened play;
  play.ball(2.4, 0.0, {2.0, 0.0});
  play.step();
  EXPECT_EQ(play.shots(Team::red), 0);
}

TEST(Shot, GoesToTheOtherEndInTheSecondHalf) {
  MatchRules rules = official();
  rules.half_ms = 5'000;
  RecordedMatch play({}, rules);
  while (play.match.ruling().half == 1) {
    play.step();
  }
  play.open_play();
  play.ball(-2.4, 0.0, {-2.0, 0.0});
  play.touched_by({red(3)});
  EXPECT_EQ(play.figures(Team::red).shots_on_target, 1);
}

TEST(Shot, IsOneWhileTheSameTeamPushesTheBall) {
  Opened play;
  for (int frame = 0; frame < 10; ++frame) {
    play.shoot(red(3), {2.0 + 0.1 * frame, 0.0}, {2.0, 0.0});
  }
  play.step();
  EXPECT_EQ(play.shots(Team::red), 1);
  EXPECT_EQ(play.on_target(Team::red), 1);
}

TEST(Shot, IsAnotherAfterTwoSeconds) {
  Opened play;
  play.shoot(red(3), {2.4, 0.0}, {2.0, 0.0});
  play.run(2'050);
  play.shoot(red(3), {2.4, 0.0}, {2.0, 0.0});
  EXPECT_EQ(play.shots(Team::red), 2);
}

TEST(Shot, IsAnotherAfterTheOpponentsTouch) {
  Opened play;
  play.shoot(red(3), {2.4, 0.0}, {2.0, 0.0});
  play.shoot(blue(1), {2.6, 0.0}, {-0.5, 0.0});
  play.shoot(red(3), {2.4, 0.0}, {2.0, 0.0});
  EXPECT_EQ(play.shots(Team::red), 2);
  EXPECT_EQ(play.saves(Team::blue), 0);  // by a defender
}

TEST(Save, IsAShotOnTargetThatTheGoalkeeperStops) {
  Opened play;
  play.shoot(red(3), {2.4, 0.0}, {2.0, 0.0});
  play.shoot(blue(0), {3.7, 0.0}, {-1.0, 0.0});
  play.run(1'950);
  EXPECT_EQ(play.saves(Team::blue), 0);  // it may still go in
  play.run(100);
  EXPECT_EQ(play.saves(Team::blue), 1);
  EXPECT_EQ(play.saves(Team::red), 0);
}

TEST(Save, IsNoneOfAShotThatWouldHaveMissed) {
  Opened play;
  play.shoot(red(3), {2.4, 0.0}, {2.0, 0.8});
  play.shoot(blue(0), {3.7, 0.0}, {-1.0, 0.0});
  play.run(3'000);
  EXPECT_EQ(play.saves(Team::blue), 0);
}

TEST(Save, IsNoneWhenTheReboundGoesIn) {
  Opened play;
  play.shoot(red(3), {2.4, 0.0}, {2.0, 0.0});
  play.shoot(blue(0), {3.7, 0.0}, {-1.0, 0.0});
  play.shoot(red(3), {3.6, 0.0}, {2.0, 0.0});
  play.ball(4.0, 0.0);
  play.step();
  ASSERT_EQ(play.figures(Team::red).goals, 1);
  play.run(4'000);
  EXPECT_EQ(play.saves(Team::blue), 0);
  EXPECT_EQ(play.shots(Team::red), 2);
}

TEST(Save, CountsWhenTheBallGoesOut) {
  Opened play;
  play.shoot(red(3), {2.4, 0.0}, {2.0, 0.0});
  play.shoot(blue(0), {3.7, 0.6}, {1.0, 0.5});
  play.ball(3.95, 0.8);
  play.step();
  ASSERT_EQ(play.figures(Team::red).corners.after_out, 1);
  EXPECT_EQ(play.saves(Team::blue), 1);
}

TEST(Goal, IsAShotOnTargetHoweverSlow) {
  Opened play;
  play.shoot(red(3), {3.8, 0.0}, {0.5, 0.0});
  play.ball(3.95, 0.0, {0.5, 0.0});
  play.step();
  EXPECT_EQ(play.figures(Team::red).goals, 1);
  EXPECT_EQ(play.shots(Team::red), 1);
  EXPECT_EQ(play.on_target(Team::red), 1);
}

TEST(Goal, OfAShotIsNoSecondShot) {
  Opened play;
  play.shoot(red(3), {3.6, 0.45}, {2.0, 0.5});  // seen to go wide
  play.ball(3.95, 0.48, {2.0, 0.5});
  play.step();
  EXPECT_EQ(play.figures(Team::red).goals, 1);
  EXPECT_EQ(play.shots(Team::red), 1);
  EXPECT_EQ(play.on_target(Team::red), 1);
}

TEST(Goal, OfOnesOwnIsNoShot) {
  Opened play;
  play.shoot(blue(1), {3.6, 0.0}, {2.0, 0.0});
  play.ball(3.95, 0.0);
  play.step();
  EXPECT_EQ(play.figures(Team::red).goals, 1);
  EXPECT_EQ(play.figures(Team::blue).own_goals, 1);
  EXPECT_EQ(play.figures(Team::red).own_goals, 0);
  EXPECT_EQ(play.shots(Team::red) + play.shots(Team::blue), 0);
}

}  // namespace
}  // namespace striker::sil
