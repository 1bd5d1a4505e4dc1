// SPDX-License-Identifier: Apache-2.0
// When the learned kick is ordered, and how long.
#include "sil/match/team/striker/kick_chance.hpp"

#include <gtest/gtest.h>

#include "sil/match/team/strategies.hpp"
#include "tests/match/team/views.hpp"

namespace striker::sil {
namespace {

// Forward 3 stands 1.5 m before the goal and faces it; a ball comes across from its left, and in 0.6 s it is where the
// robot's front comes.
struct Scene {
  Scene() : view(home_view()) {
    view.own[3].pose = {2.4, 0.1, 0.0};
    roll({2.8, 1.0}, {-0.2, -1.5});
  }
  void roll(Vec2 place, Vec2 velocity_m_s) {
    view.ball_m = {place.x - 0.05 * velocity_m_s.x, place.y - 0.05 * velocity_m_s.y};
    ball.see(view);
    view.ball_m = place;
    ball.see(view);
  }
  Situation now() { return {.view = view, .ball = ball, .interceptions = {}, .chaser = nobody}; }
  bool has_chance(std::size_t id = 3) { return has_kick_chance(now(), id); }
  void next(Vec2 place) {
    view.ball_m = place;
    ball.see(view);
  }

  TeamView view;
  BallTrack ball;
};

TEST(KickChance, IsABallThatComesAcross) {
  Scene scene;
  EXPECT_TRUE(scene.has_chance());
  EXPECT_FALSE(scene.has_chance(4));
}

TEST(KickChance, IsOfForwardsThatMayMoveInOpenPlay) {
  Scene scene;
  scene.view.own[1].pose = scene.view.own[3].pose;
  EXPECT_FALSE(scene.has_chance(1));
  scene.view.own[3].active = false;
  EXPECT_FALSE(scene.has_chance());
  scene.view.own[3].active = true;
  scene.view.state = GameState::corner;
  EXPECT_FALSE(scene.has_chance());
}

TEST(KickChance, NeedsAFrontToTheGoal) {
  Scene scene;
  scene.view.own[3].pose.heading_rad = 0.3;  // at y = 0.56
  EXPECT_FALSE(scene.has_chance());
  scene.view.own[3].pose.heading_rad = 3.1;
  EXPECT_FALSE(scene.has_chance());
}

TEST(KickChance, NeedsAGoalInReach) {
  Scene scene;
  scene.view.own[3].pose.x_m = 1.5;
  scene.roll({1.9, 1.0}, {-0.2, -1.5});
  EXPECT_FALSE(scene.has_chance());
  scene.view.own[3].pose.x_m = 3.4;
  scene.roll({3.8, 1.0}, {-0.2, -1.5});
  EXPECT_FALSE(scene.has_chance());
}

TEST(KickChance, NeedsABallAsItWasLearned) {
  const std::pair<Vec2, Vec2> balls[] = {
      {{2.7, 0.4}, {0.0, -0.6}},    // slow
      {{2.8, 1.8}, {-0.2, -2.5}},   // crosses fast
      {{3.3, 0.2}, {-1.2, -0.2}},   // crosses slowly
      {{2.8, 1.0}, {0.2, 1.5}},     // goes away
      {{2.8, 1.7}, {-0.1, -1.4}},   // comes late
      {{2.53, 0.4}, {-0.1, -1.5}},  // comes too soon
      {{3.3, 1.15}, {0.0, -1.5}},   // passes too far ahead
      {{1.95, 1.0}, {0.0, -1.5}},   // passes too far behind
      {{2.5, 0.4}, {1.1, -0.8}},    // leaves ahead
      {{3.5, 0.4}, {-2.0, 0.0}},    // does not cross
  };
  for (const auto& [place, velocity] : balls) {
    SCOPED_TRACE(testing::Message() << place.x << ", " << place.y);
    Scene scene;
    scene.roll(place, velocity);
    EXPECT_FALSE(scene.has_chance());
  }
}

TEST(Kicks, GoOnUnderTheSameNumberUntilTheTouch) {
  Scene scene;
  Kicks kicks;
  ASSERT_EQ(kicks.kicker(scene.now()), 3U);
  const MotionOrder first = kicks.order(scene.now());
  EXPECT_EQ(first.motion, Motion::kick);
  EXPECT_DOUBLE_EQ(first.target.x_m, 3.9);
  EXPECT_DOUBLE_EQ(first.target.y_m, 0.1);
  scene.next({2.79, 0.93});
  ASSERT_EQ(kicks.kicker(scene.now()), 3U);
  EXPECT_EQ(kicks.order(scene.now()).number, first.number);
  scene.next({2.6, 0.2});
  scene.view.own[3].touching = true;
  int frames = 0;
  while (kicks.kicker(scene.now()) == 3U && frames < 100) {
    scene.view.own[3].touching = false;
    scene.next({scene.view.ball_m.x + 0.01, scene.view.ball_m.y});
    ++frames;
  }
  EXPECT_LE(frames, 3);
  EXPECT_GE(frames, 1);
}

TEST(Kicks, EndAfterTheirFortyDecisions) {
  Scene scene;
  Kicks kicks;
  int frames = 0;
  while (kicks.kicker(scene.now()) == 3U && frames < 100) {
    scene.next(scene.view.ball_m);  // it has stopped
    ++frames;
  }
  EXPECT_EQ(frames, 40);
}

TEST(Kicks, EndWhenTheBallIsGoneOrPlayStops) {
  Scene gone;
  Kicks first;
  ASSERT_EQ(first.kicker(gone.now()), 3U);
  gone.next({2.8, 1.1});  // back to where it came from
  EXPECT_EQ(first.kicker(gone.now()), nobody);
  Scene stopped;
  Kicks second;
  ASSERT_EQ(second.kicker(stopped.now()), 3U);
  stopped.view.reset_reason = ResetReason::deadlock;
  stopped.next({2.79, 0.93});
  EXPECT_EQ(second.kicker(stopped.now()), nobody);
}

TEST(Kicks, HaveANewNumberEach) {
  std::uint8_t before = 0;
  Kicks kicks;
  for (int kick = 0; kick < 6; ++kick) {
    Scene scene;
    ASSERT_EQ(kicks.kicker(scene.now()), 3U);
    const std::uint8_t number = kicks.order(scene.now()).number;
    EXPECT_LT(number, 4);
    EXPECT_NE(number, before);
    before = number;
    scene.next({2.8, 1.1});
    ASSERT_EQ(kicks.kicker(scene.now()), nobody);
  }
}

TEST(StrikerTeam, OrdersTheKickAndStrikerDrivingDoesNot) {
  for (const bool kicks : {true, false}) {
    const auto team = make_strategy(kicks ? "striker" : "striker-driving", 1);
    Scene scene;
    scene.view.ball_m = {2.81, 1.075};
    (void)team->play(scene.view);
    scene.view.ball_m = {2.8, 1.0};
    const TeamOrders orders = team->play(scene.view);
    EXPECT_EQ(std::holds_alternative<MotionOrder>(orders[3].value()), kicks);
    EXPECT_TRUE(std::holds_alternative<SpeedOrder>(orders[4].value()));
  }
}

}  // namespace
}  // namespace striker::sil
