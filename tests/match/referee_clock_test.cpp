// SPDX-License-Identifier: Apache-2.0
// Clocks, pauses and halves.
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/match/played_match.hpp"

namespace striker::sil {
namespace {

MatchRules short_halves(int half_ms) {
  MatchRules rules = official();
  rules.half_ms = half_ms;
  return rules;
}

TEST(Referee, OpensWithRedsKickoffAndOneSecondToSettle) {
  PlayedMatch match;
  EXPECT_EQ(match.ruling().state, GameState::pause);
  EXPECT_EQ(match.ruling().pause_ms, 1000);
  ASSERT_TRUE(match.ruling().placements.ball);
  EXPECT_EQ(match.ruling().placements.robots[red(4)]->x_m, 0.4);
  match.run(950);
  EXPECT_EQ(match.ruling().state, GameState::pause);
  EXPECT_EQ(match.ruling().reset_reason, ResetReason::none);
  match.step();
  EXPECT_EQ(match.ruling().state, GameState::kickoff);
  EXPECT_EQ(match.ruling().owner, Team::red);
  EXPECT_EQ(match.ruling().reset_reason, ResetReason::game_start);
  EXPECT_EQ(match.ruling().clock_ms, 0);
  EXPECT_EQ(match.ruling().sim_ms, 1000);
  match.step();
  EXPECT_EQ(match.ruling().reset_reason, ResetReason::none);
  EXPECT_EQ(match.ruling().clock_ms, 50);
}

TEST(Referee, TheLastFramesGoalDoesNotCount) {
  for (const int goal_ms : {4900, 4950, 5000}) {
    PlayedMatch match(short_halves(5000));
    match.open_play();
    match.run(goal_ms - 50 - match.ruling().clock_ms);
    match.ball(4.0, 0.0);
    match.step();
    EXPECT_EQ(match.ruling().clock_ms, goal_ms);
    EXPECT_EQ(match.ruling().score[0], goal_ms < 5000 ? 1 : 0);
    EXPECT_EQ(match.count(EventKind::half_over), goal_ms < 5000 ? 0U : 1U);
  }
}

TEST(Referee, ClockAndDeadTimeAreTheSimulatedTime) {
  PlayedMatch match;
  int frame = 0;
  while (match.ruling().state != GameState::over) {
    ++frame;
    const bool open = match.ruling().state == GameState::open_play;
    if (open && frame % 401 == 0) {
      match.ball(frame % 2 == 0 ? 4.0 : -4.0, 0.2);
    } else if (open && frame % 301 == 0) {
      match.ball(1.0, 2.4);
    } else if (frame % 501 < 100) {
      match.ball(1.0, 0.5, 0.0);
    } else if (open) {
      match.ball(1.0, 0.5, 1.0);
    }
    match.step();
    ASSERT_EQ(match.ruling().sim_ms, frame * 50);
  }
  const std::size_t goals = match.count(EventKind::goal);
  const std::size_t others = match.count(EventKind::ball_out) + match.count(EventKind::deadlock);
  EXPECT_GT(match.count(EventKind::goal), 5U);
  EXPECT_GT(match.count(EventKind::ball_out), 5U);
  EXPECT_GT(match.count(EventKind::deadlock), 5U);
  const std::size_t dead_ms = 1000 + 4000 + 3000 + 4000 * goals + 2000 * others;
  EXPECT_EQ(match.ruling().sim_ms, static_cast<std::int64_t>(600'000 + dead_ms));
  EXPECT_EQ(match.ruling().score[0] + match.ruling().score[1], static_cast<int>(goals));
}

TEST(Referee, APauseStopsTheClockAndEverybody) {
  PlayedMatch match;
  match.open_play();
  match.ball(4.0, 0.0);
  match.step();
  const int clock_ms = match.ruling().clock_ms;
  for (int frame = 1; frame <= 80; ++frame) {
    EXPECT_EQ(match.ruling().state, GameState::pause) << frame;
    EXPECT_EQ(match.ruling().pause_ms, frame <= 60 ? 3000 - 50 * (frame - 1) : 1000 - 50 * (frame - 61))
        << frame;
    EXPECT_EQ(match.ruling().owner, std::nullopt);
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      EXPECT_FALSE(match.ruling().may_move(robot));
    }
    match.step();
    EXPECT_EQ(match.ruling().clock_ms, clock_ms);
    EXPECT_EQ(match.ruling().placements.ball.has_value(), frame == 60) << frame;
    EXPECT_EQ(match.ruling().reset_reason, frame == 80 ? ResetReason::red_scored : ResetReason::none)
        << frame;
  }
  EXPECT_EQ(match.ruling().state, GameState::kickoff);
  EXPECT_EQ(match.ruling().owner, Team::blue);
}

TEST(Referee, WhatHappensInAPauseCountsForNothing) {
  PlayedMatch match;
  match.open_play();
  match.ball(4.0, 0.0);
  match.step();
  const std::size_t events = match.log.size();
  for (int frame = 0; frame < 79; ++frame) {
    match.ball(-4.0, 0.0);
    match.put(red(3), 5.0, 0.0);
    match.put(blue(0), -3.7, 0.0);
    match.touch(red(3));
    match.frame.standing.reset();
    match.step();
  }
  EXPECT_EQ(match.ruling().score, (std::array{1, 0}));
  EXPECT_EQ(match.log.size(), events + 1);  // the kickoff's placements
  EXPECT_TRUE(match.log.back().last_touch.none());
}

TEST(Referee, TheSecondHalfBeginsAtTheOtherEndsWithBluesKickoff) {
  PlayedMatch match(short_halves(5000));
  match.open_play();
  while (match.ruling().clock_ms < 5000) {
    match.step();
  }
  EXPECT_EQ(match.ruling().reset_reason, ResetReason::half_time);
  EXPECT_EQ(match.ruling().half, 1);
  match.run(2950);
  EXPECT_EQ(match.ruling().half, 1);
  match.step();
  EXPECT_EQ(match.ruling().half, 2);
  EXPECT_EQ(match.ruling().clock_ms, 0);
  EXPECT_EQ(match.frame.robots[red(0)].x_m, 3.8);
  EXPECT_EQ(match.frame.robots[blue(0)].x_m, -3.8);
  EXPECT_EQ(match.frame.robots[blue(4)].x_m, 0.4);
  EXPECT_NEAR(match.frame.robots[blue(0)].heading_rad, 0.5 * std::numbers::pi, 1e-12);
  match.run(1000);
  EXPECT_EQ(match.ruling().state, GameState::kickoff);
  EXPECT_EQ(match.ruling().owner, Team::blue);
  EXPECT_EQ(match.ruling().reset_reason, ResetReason::game_start);
  match.ball(0.6, 0.0);
  match.step();
  match.ball(4.0, 0.0);  // red's goal is at this end now
  match.step();
  EXPECT_EQ(match.ruling().score, (std::array{0, 1}));
}

TEST(Referee, AMatchThatIsOverStaysAsItIs) {
  PlayedMatch match(short_halves(1000));
  for (int frame = 0; frame < 1000 && match.ruling().state != GameState::over; ++frame) {
    match.step();
    EXPECT_NE(match.ruling().reset_reason == ResetReason::game_end,
              match.ruling().events.empty() || match.ruling().events.back().kind != EventKind::match_over);
  }
  EXPECT_EQ(match.ruling().sim_ms, 2 * 1000 + 1000 + 4000 + 3000);
  const std::size_t events = match.log.size();
  match.ball(4.0, 0.0);
  match.run(10'000);
  EXPECT_EQ(match.ruling().state, GameState::over);
  EXPECT_EQ(match.ruling().clock_ms, 1000);
  EXPECT_EQ(match.ruling().sim_ms, 10'000);
  EXPECT_EQ(match.log.size(), events);
  EXPECT_FALSE(match.ruling().may_move(red(4)));
}

TEST(Referee, RefusesRulesThatItCannotCount) {
  const auto with = [](auto change) {
    MatchRules rules = official();
    change(rules);
    return rules;
  };
  EXPECT_THROW(Referee(with([](MatchRules& rules) { rules.half_ms = 1020; })), std::invalid_argument);
  EXPECT_THROW(Referee(with([](MatchRules& rules) { rules.settle_ms = 0; })), std::invalid_argument);
  EXPECT_THROW(Referee(with([](MatchRules& rules) { rules.deadlock_ms = -50; })), std::invalid_argument);
  EXPECT_THROW(Referee(with([](MatchRules& rules) { rules.half_ms = 2'000'000'000; })),
               std::invalid_argument);
  EXPECT_THROW(Referee(with([](MatchRules& rules) { rules.clearance_m = 0.0; })), std::invalid_argument);
  EXPECT_THROW(Referee(with([](MatchRules& rules) { rules.most_attackers = -1; })), std::invalid_argument);
  EXPECT_NO_THROW(Referee(with([](MatchRules& rules) { rules.half_ms = 50; })));
}

}  // namespace
}  // namespace striker::sil
