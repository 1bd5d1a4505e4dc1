// SPDX-License-Identifier: Apache-2.0
// Who may move in a set piece, and what ends it.
#include <gtest/gtest.h>

#include "tests/match/played_match.hpp"

namespace striker::sil {
namespace {

// Into a goal kick of red, a corner kick of blue at red's end, and a penalty kick of blue.
void to_goal_kick(PlayedMatch& match) {
  match.open_play();
  match.touch(blue(3));
  match.ball(-3.95, 1.0);
  match.step();
  match.run_until_play();
  ASSERT_EQ(match.ruling().state, GameState::goal_kick);
  ASSERT_EQ(match.ruling().owner, Team::red);
}
void to_corner(PlayedMatch& match) {
  match.open_play();
  match.touch(red(1));
  match.ball(-3.95, 1.0);
  match.step();
  match.run_until_play();
  ASSERT_EQ(match.ruling().state, GameState::corner);
  ASSERT_EQ(match.ruling().owner, Team::blue);
}
void to_penalty(PlayedMatch& match) {
  match.open_play();
  for (const std::size_t id : {1U, 2U, 3U}) {
    match.put(red(id), -3.2, -0.3 + 0.2 * static_cast<double>(id));
  }
  match.ball(-3.3, -0.5);
  match.step();
  match.run_until_play();
  ASSERT_EQ(match.ruling().state, GameState::penalty);
  ASSERT_EQ(match.ruling().owner, Team::blue);
}

void only_may_move(const Ruling& ruling, std::size_t robot) {
  for (std::size_t other = 0; other < robots_in_match; ++other) {
    EXPECT_EQ(ruling.may_move(other), other == robot) << other;
    EXPECT_FALSE(ruling.sent_out[other]);
  }
}
void everybody_may_move(const Ruling& ruling) {
  EXPECT_EQ(ruling.state, GameState::open_play);
  EXPECT_EQ(ruling.owner, std::nullopt);
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    EXPECT_TRUE(ruling.may_move(robot)) << robot;
  }
}

// One frame with this touch: does it end the set piece?
bool is_ended_by(PlayedMatch match, std::size_t toucher) {
  match.touch(toucher);
  match.step();
  return match.ruling().state == GameState::open_play;
}

void ends_by_time_alone(PlayedMatch match) {
  const int start_ms = match.ruling().clock_ms;
  const GameState state = match.ruling().state;
  match.run(2950);
  EXPECT_EQ(match.ruling().state, state);
  match.step();
  everybody_may_move(match.ruling());
  EXPECT_EQ(match.ruling().clock_ms, start_ms + 3000);
  EXPECT_EQ(match.last(EventKind::set_piece_over).cause, Cause::time);
  EXPECT_EQ(match.last(EventKind::set_piece_over).timer_ms, 3000);
}

TEST(RefereeSetPiece, AKickoffIsTheKickersUntilTheBallLeavesTheCircle) {
  PlayedMatch match;
  match.run_until_play();
  only_may_move(match.ruling(), red(4));
  ends_by_time_alone(match);
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    EXPECT_FALSE(is_ended_by(match, robot)) << robot;
  }
  match.ball(0.3, 0.4);
  match.step();
  EXPECT_EQ(match.ruling().state, GameState::kickoff);
  match.ball(0.3, 0.401);
  match.step();
  everybody_may_move(match.ruling());
  EXPECT_EQ(match.last(EventKind::set_piece_over).cause, Cause::ball_left);
}

TEST(RefereeSetPiece, AnUntouchedKickoffIsFreeAfterThreeSecondsAndDeadAfterSeven) {
  PlayedMatch match;
  match.run_until_play();
  match.run(2950);
  EXPECT_EQ(match.ruling().state, GameState::kickoff);
  match.step();
  everybody_may_move(match.ruling());
  match.run(3950);
  EXPECT_EQ(match.count(EventKind::deadlock), 0U);
  match.step();
  EXPECT_EQ(match.last(EventKind::deadlock).clock_ms, 7000);
  match.run(1000);
  EXPECT_EQ(match.ruling().placements.ball->position_m, (Vec2{1.5, -1.0}));
  EXPECT_EQ(match.ruling().placements.ball->height_m, 0.2);
  for (const auto& robot : match.ruling().placements.robots) {
    EXPECT_EQ(robot, std::nullopt);
  }
  match.run(1000);
  everybody_may_move(match.ruling());
  EXPECT_EQ(match.ruling().reset_reason, ResetReason::deadlock);
  EXPECT_EQ(match.ruling().clock_ms, 7000);
}

TEST(RefereeSetPiece, AGoalKickIsTheGoalkeepersUntilItTouches) {
  PlayedMatch match;
  to_goal_kick(match);
  EXPECT_EQ(match.ruling().reset_reason, ResetReason::goal_kick);
  EXPECT_EQ(match.frame.ball.position_m, (Vec2{-3.25, 0.0}));
  only_may_move(match.ruling(), red(0));
  ends_by_time_alone(match);
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    EXPECT_EQ(is_ended_by(match, robot), robot == red(0)) << robot;
  }
}

TEST(RefereeSetPiece, ACornerKickIsRobotFoursUntilAnyOfItsTeamTouches) {
  PlayedMatch match;
  to_corner(match);
  EXPECT_EQ(match.ruling().reset_reason, ResetReason::corner_kick);
  EXPECT_EQ(match.frame.ball.position_m, (Vec2{-2.75, 1.5}));
  only_may_move(match.ruling(), blue(4));
  ends_by_time_alone(match);
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    EXPECT_EQ(is_ended_by(match, robot), team_of(robot) == Team::blue) << robot;
  }
}

TEST(RefereeSetPiece, APenaltyKickIsRobotFoursUntilItTouches) {
  PlayedMatch match;
  to_penalty(match);
  EXPECT_EQ(match.ruling().reset_reason, ResetReason::penalty_kick);
  EXPECT_EQ(match.frame.ball.position_m, (Vec2{-2.95, 0.0}));
  only_may_move(match.ruling(), blue(4));
  ends_by_time_alone(match);
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    EXPECT_EQ(is_ended_by(match, robot), robot == blue(4)) << robot;
  }
}

TEST(RefereeSetPiece, TheSecondToSettleIsNotOfTheThree) {
  PlayedMatch match;
  to_corner(match);
  EXPECT_EQ(match.ruling().clock_ms, 100);
  match.run(2950);
  EXPECT_EQ(match.ruling().state, GameState::corner);
}

TEST(RefereeSetPiece, NoGoalAndNoOutIsGivenInOne) {
  for (const auto& to : {to_goal_kick, to_corner, to_penalty}) {
    for (const Vec2 ball : {Vec2{4.0, 0.0}, Vec2{-4.0, 0.0}, Vec2{0.0, 2.4}}) {
      PlayedMatch match;
      to(match);
      const std::size_t events = match.log.size();
      match.ball(ball.x, ball.y);
      match.run(2950);
      EXPECT_EQ(match.log.size(), events);
      match.step();  // ends it
      match.step();
      EXPECT_EQ(match.ruling().state, GameState::pause);
    }
  }
}

// A touch of the frame before it began, or of its pause, is none of the set piece's.
TEST(RefereeSetPiece, OnlyAFreshTouchEndsIt) {
  PlayedMatch match;
  match.open_play();
  match.touch(red(1));
  match.ball(-3.95, 1.0);
  match.step();
  while (match.ruling().state == GameState::pause) {
    match.touch(blue(4));
    match.step();
  }
  match.step();
  EXPECT_EQ(match.ruling().state, GameState::corner);
}

}  // namespace
}  // namespace striker::sil
