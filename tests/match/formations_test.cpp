// SPDX-License-Identifier: Apache-2.0
// Every set piece, for either owner and every corner: nobody stands on anybody, in a wall or out of the field.
#include "sil/match/referee/formations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sil/match/referee/areas.hpp"
#include "sil/match/referee/free_spot.hpp"
#include "tests/match/played_match.hpp"

namespace striker::sil {
namespace {

constexpr std::array set_pieces = {GameState::kickoff, GameState::goal_kick, GameState::corner,
                                   GameState::penalty};
constexpr std::array<Vec2, 4> quadrants = {Vec2{-3.5, 2.0}, Vec2{-3.5, -2.0}, Vec2{3.5, 2.0},
                                           Vec2{3.5, -2.0}};

Vec2 position(const Pose& pose) {
  return {pose.x_m, pose.y_m};
}
double distance(Vec2 a, Vec2 b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

template <typename Check>
void for_every_line_up(Check check) {
  for (const GameState set_piece : set_pieces) {
    for (const Team owner : teams) {
      for (const Vec2 ball : quadrants) {
        SCOPED_TRACE(std::string(name_of(set_piece)) + (owner == Team::red ? " of red" : " of blue") +
                     " at " + std::to_string(ball.x) + " " + std::to_string(ball.y));
        check(line_up_of(set_piece, owner, ball), set_piece, owner, ball);
      }
    }
  }
}

TEST(Formations, LeaveRoomBetweenAnyTwoBodies) {
  for_every_line_up([](const LineUp& line_up, GameState, Team, Vec2) {
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      EXPECT_GE(distance(position(line_up.robots[robot]), line_up.ball), robot_reach_m + ball_reach_m + 0.02)
          << robot;
      for (std::size_t other = 0; other < robot; ++other) {
        EXPECT_GE(distance(position(line_up.robots[robot]), position(line_up.robots[other])),
                  2 * robot_reach_m + 0.02)
            << robot << " " << other;
      }
    }
  });
}

TEST(Formations, StandInsideTheField) {
  for_every_line_up([](const LineUp& line_up, GameState, Team, Vec2) {
    EXPECT_TRUE(is_clear_of_walls(line_up.ball, ball_reach_m));
    for (const Pose& robot : line_up.robots) {
      // A goalkeeper stands 0.1 m before its line, in front of the open goal: half a side is what counts there.
      const bool before_goal = std::abs(robot.y_m) < goal_half_width_m - robot_reach_m;
      EXPECT_TRUE(is_clear_of_walls(position(robot), before_goal ? 0.5 * robot_side_m : robot_reach_m));
      EXPECT_FALSE(has_left_field(position(robot)));
      EXPECT_LE(std::abs(robot.heading_rad), std::numbers::pi);
    }
  });
}

TEST(Formations, NobodyBreaksARuleByStandingThere) {
  for_every_line_up([](const LineUp& line_up, GameState, Team, Vec2) {
    EXPECT_FALSE(in_a_goal(line_up.ball));
    EXPECT_FALSE(is_out(line_up.ball));
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      const Vec2 own = team_of(robot) == Team::red ? position(line_up.robots[robot])
                                                   : turned(position(line_up.robots[robot]));
      EXPECT_FALSE(in_opponents_goal_area(own));
      EXPECT_TRUE(id_of(robot) != goalkeeper_id || keeper_is_home(own));
    }
  });
}

TEST(Formations, TheKickerFacesTheBallAndIsItsTeamsNearest) {
  for_every_line_up([](const LineUp& line_up, GameState set_piece, Team owner, Vec2) {
    const Pose& kicker = line_up.robots[kicker_of(set_piece, owner)];
    const double bearing = std::atan2(line_up.ball.y - kicker.y_m, line_up.ball.x - kicker.x_m);
    EXPECT_NEAR(std::remainder(bearing - kicker.heading_rad, 2 * std::numbers::pi), 0.0, 1e-9);
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      const Vec2 mate = position(line_up.robots[robot_of(owner, id)]);
      EXPECT_LE(distance(position(kicker), line_up.ball), distance(mate, line_up.ball));
    }
  });
}

TEST(Formations, BothColoursHaveTheSame) {
  for_every_line_up([](const LineUp& line_up, GameState set_piece, Team owner, Vec2 ball) {
    const LineUp other = line_up_of(set_piece, opponent_of(owner), turned(ball));
    EXPECT_EQ(line_up.ball, turned(other.ball));
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      const Pose& twin = other.robots[robot_of(opponent_of(team_of(robot)), id_of(robot))];
      EXPECT_EQ(position(line_up.robots[robot]), turned(position(twin)));
    }
  });
}

TEST(Formations, ACornerKickIsTakenInTheBallsCorner) {
  for (const Team owner : teams) {
    for (const Vec2 ball : quadrants) {
      EXPECT_EQ(line_up_of(GameState::corner, owner, ball).ball,
                (Vec2{std::copysign(2.75, ball.x), std::copysign(1.5, ball.y)}));
    }
  }
}

TEST(Formations, TheBallOfAGoalKickAndAPenaltyIsAtTheRightEnd) {
  EXPECT_EQ(line_up_of(GameState::goal_kick, Team::red, {}).ball, (Vec2{-3.25, 0.0}));
  EXPECT_EQ(line_up_of(GameState::goal_kick, Team::blue, {}).ball.x, 3.25);
  EXPECT_EQ(line_up_of(GameState::penalty, Team::red, {}).ball, (Vec2{2.95, 0.0}));
  EXPECT_EQ(line_up_of(GameState::penalty, Team::blue, {}).ball.x, -2.95);
}

TEST(Formations, ZeroCountsAsBluesEndAndAsTheLowSide) {
  EXPECT_EQ(drop_spot({0.0, 0.0}), (Vec2{1.5, -1.0}));
  EXPECT_EQ(drop_spot({-0.1, 0.1}), (Vec2{-1.5, 1.0}));
  EXPECT_EQ(line_up_of(GameState::corner, Team::red, {0.0, 0.0}).ball, (Vec2{2.75, -1.5}));
}

// A few rows against the published table, which the code holds in other words.
TEST(Formations, AreThePublishedOnes) {
  EXPECT_EQ(home_spot(0), (Pose{-3.8, 0.0, 0.5 * std::numbers::pi}));
  EXPECT_EQ(home_spot(3), (Pose{-0.65, 0.3, 0.0}));
  EXPECT_EQ(position(line_up_of(GameState::kickoff, Team::red, {}).robots[red(4)]), (Vec2{0.4, 0.0}));
  EXPECT_EQ(position(line_up_of(GameState::kickoff, Team::blue, {}).robots[red(4)]), (Vec2{-0.65, -0.3}));
  // Red's corner kick at blue's end, ball high: red attacks as "BC attack-attack", blue stands as "BC attack-defence".
  const LineUp corner = line_up_of(GameState::corner, Team::red, {3.5, 2.0});
  EXPECT_EQ(corner.robots[red(1)], (Pose{3.25, 1.0, -0.5 * std::numbers::pi}));
  EXPECT_EQ(corner.robots[red(4)], (Pose{2.75, 2.0, -0.5 * std::numbers::pi}));
  EXPECT_EQ(position(corner.robots[blue(1)]), (Vec2{3.25, -0.5}));
  EXPECT_NEAR(corner.robots[blue(1)].heading_rad, 0.5 * std::numbers::pi, 1e-12);
  // Red's corner kick at its own end, ball high: "AD defence-attack".
  const LineUp own = line_up_of(GameState::corner, Team::red, {-3.5, 2.0});
  EXPECT_EQ(position(own.robots[red(2)]), (Vec2{-3.25, 1.0}));
  EXPECT_EQ(position(own.robots[blue(3)]), (Vec2{0.5, -0.8}));
}

TEST(Formations, SlotsLieApartInsideTheBlockBesideTheOwnGoal) {
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    EXPECT_TRUE(has_left_field(position(slot(id))));
    EXPECT_EQ(slot(id).x_m, -4.05);
    EXPECT_NEAR(slot(id).y_m, -0.85 - 0.3 * static_cast<double>(id), 1e-12);
  }
}

}  // namespace
}  // namespace striker::sil
