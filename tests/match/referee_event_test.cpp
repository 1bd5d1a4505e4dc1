// SPDX-License-Identifier: Apache-2.0
// What events tell, and that they are edges.
#include <gtest/gtest.h>

#include <set>

#include "tests/match/played_match.hpp"

namespace striker::sil {
namespace {

TEST(RefereeEvent, AGoalTellsEverythingThatDecidedIt) {
  PlayedMatch match;
  match.open_play();
  match.touch(red(3));
  match.touch(red(4));
  match.ball(3.8, 0.2, 3.0);
  match.step();
  match.ball(4.0, 0.4, 2.5);
  match.step();
  const MatchEvent event = match.last(EventKind::goal);
  EXPECT_EQ(event.seq, 3U);  // after restart, resumed, set_piece_over
  EXPECT_EQ(event.cause, Cause::scored);
  EXPECT_EQ(event.sim_ms, 1150);
  EXPECT_EQ(event.half, 1);
  EXPECT_EQ(event.clock_ms, 150);
  EXPECT_EQ(event.score, (std::array{1, 0}));
  EXPECT_EQ(event.team, Team::red);
  EXPECT_EQ(event.set_piece, GameState::kickoff);
  EXPECT_EQ(event.last_touch, RobotSet().set(red(3)).set(red(4)));
  EXPECT_EQ(event.counts, (std::array{2, 0}));
  EXPECT_EQ(event.ball.position_m, (Vec2{4.0, 0.4}));
  EXPECT_EQ(event.ball.speed_m_s, 2.5);
  ASSERT_TRUE(event.exit_m);
  EXPECT_NEAR(event.exit_m->x, 3.9, 1e-12);
  EXPECT_NEAR(event.exit_m->y, 0.3, 1e-12);
}

TEST(RefereeEvent, ARestartTellsWhatFollowsAndWhere) {
  PlayedMatch match;
  match.open_play();
  match.ball(-3.95, 1.0);
  match.step();
  match.run_until_play();
  const MatchEvent placed = match.last(EventKind::restart);
  EXPECT_EQ(placed.cause, Cause::after_out);
  EXPECT_EQ(placed.set_piece, GameState::corner);
  EXPECT_EQ(placed.team, Team::blue);
  ASSERT_TRUE(placed.ball_placement);
  EXPECT_EQ(placed.ball_placement->position_m, (Vec2{-2.75, 1.5}));
  EXPECT_FALSE(placed.spot_was_taken);
  const MatchEvent resumed = match.last(EventKind::resumed);
  EXPECT_EQ(resumed.cause, Cause::after_out);
  EXPECT_EQ(resumed.set_piece, GameState::corner);
  EXPECT_EQ(resumed.sim_ms, placed.sim_ms + 1000);
  EXPECT_EQ(resumed.clock_ms, placed.clock_ms);
}

TEST(RefereeEvent, PlacesOfTheSecondHalfAreInTheFieldFrame) {
  MatchRules rules = official();
  rules.half_ms = 5000;
  PlayedMatch match(rules);
  while (match.ruling().half == 1) {
    match.step();
  }
  match.open_play();
  match.put(red(2), -5.0, 0.2);  // behind blue's goal, now
  match.ball(3.7, 2.3);
  match.step();
  match.ball(3.72, 2.36);
  match.step();
  EXPECT_EQ(match.last(EventKind::sent_out).robot_placement, turned(slot(2)));
  EXPECT_EQ(match.last(EventKind::ball_out).ball.position_m, (Vec2{3.72, 2.36}));
  EXPECT_EQ(match.last(EventKind::ball_out).exit_m->y, 2.325);
  match.run_until_play();
  EXPECT_EQ(match.ruling().owner, Team::blue);  // attacks red's end, at +x
  EXPECT_EQ(match.last(EventKind::restart).ball_placement->position_m, (Vec2{2.75, 1.5}));
}

// Whatever lasts is told once.
TEST(RefereeEvent, WhatLastsIsToldOnce) {
  PlayedMatch match;
  match.open_play();
  match.put(red(1), -5.0, 0.0);
  match.put(blue(3), -2.25, 1.0);  // in its way back
  match.put(red(3), 3.6, 0.0);
  match.put(blue(4), -0.65, 0.3);  // in its way home
  match.frame.standing.reset(blue(2));
  match.run(20'000);
  // Red 1 and blue 2, which returns. Red 3 still waits, and so its goalkeeper plays.
  EXPECT_EQ(match.count(EventKind::sent_out), 2U);
  EXPECT_EQ(match.count(EventKind::sent_home), 0U);
  EXPECT_EQ(match.count(EventKind::returned), 1U);
}

TEST(RefereeEvent, NamesAreOneForEachValue) {
  std::set<std::string_view> names;
  for (const std::string_view name : event_kind_names) {
    EXPECT_TRUE(!name.empty() && names.insert(name).second) << name;
  }
  names.clear();
  for (const std::string_view name : cause_names) {
    EXPECT_TRUE(!name.empty() && names.insert(name).second) << name;
  }
  EXPECT_EQ(name_of(EventKind::returned), "returned");
  EXPECT_EQ(name_of(Cause::keeper_away), "keeper_away");
  EXPECT_EQ(name_of(Cause::drop), "drop");
  EXPECT_EQ(name_of(GameState::over), "over");
}

}  // namespace
}  // namespace striker::sil
