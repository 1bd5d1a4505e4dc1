// SPDX-License-Identifier: Apache-2.0
// What the team `striker` decides by: the ball's way, and who goes for it.
#include "sil/match/team/striker/situation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sil/world/physics_constants.hpp"
#include "sil/world/world.hpp"
#include "tests/match/team/views.hpp"

namespace striker::sil {
namespace {

BallTrack track_of(Vec2 ball, Vec2 velocity_m_s) {
  BallTrack track;
  TeamView view = home_view();
  view.ball_m = {ball.x - 0.05 * velocity_m_s.x, ball.y - 0.05 * velocity_m_s.y};
  track.see(view);
  view.ball_m = ball;
  track.see(view);
  return track;
}

TEST(BallTrack, MeasuresVelocityFromTwoFrames) {
  const BallTrack track = track_of({1.0, 0.5}, {2.0, -1.0});
  EXPECT_NEAR(track.velocity_m_s().x, 2.0, 1e-12);
  EXPECT_NEAR(track.velocity_m_s().y, -1.0, 1e-12);
  EXPECT_EQ(track.now(), (Vec2{1.0, 0.5}));
}

TEST(BallTrack, ForgetsItsVelocityAtAStop) {
  BallTrack track = track_of({1.0, 0.5}, {2.0, -1.0});
  TeamView view = home_view();
  view.ball_m = {-1.5, 1.0};
  view.reset_reason = ResetReason::deadlock;
  track.see(view);
  EXPECT_EQ(track.velocity_m_s(), Vec2{});
  EXPECT_EQ(track.in(1.0), view.ball_m);
}

TEST(BallTrack, LosesAFifthOfItsSpeedASecond) {
  const BallTrack track = track_of({-3.0, 0.0}, {1.0, 0.0});
  const double rolled_m = track.in(1.0).x + 3.0;
  EXPECT_NEAR(rolled_m, (1.0 - kept_after_1_s) / damping_per_s, 1e-9);
  EXPECT_NEAR(track.in(2.0).x - track.in(1.0).x, kept_after_1_s * rolled_m, 1e-9);
}

TEST(BallTrack, ComesBackFromWallsButNotFromGoals) {
  EXPECT_LT(track_of({0.0, 2.2}, {0.0, 2.0}).in(0.5).y, 2.2);
  EXPECT_GT(track_of({0.0, -2.2}, {0.0, -2.0}).in(0.5).y, -2.2);
  EXPECT_LT(track_of({3.8, 1.0}, {2.0, 0.0}).in(0.5).x, 3.8);
  EXPECT_GT(track_of({3.8, 0.1}, {2.0, 0.0}).in(0.5).x, 4.5);
}

// The world itself rolls the ball for 1 s, off a side wall; there it spins too, and loses a little of its way along.
TEST(BallTrack, AgreesWithTheWorld) {
  World world({});
  world.place_robot(0, {-3.0, -2.0, 0.0});
  world.place_ball({{-1.0, 1.2}, {1.5, 2.0}});
  TeamView view = home_view();
  BallTrack track;
  const auto roll = [&world](int steps) {
    for (int step = 0; step < steps; ++step) {
      world.step();
    }
  };
  for (int frame = 0; frame < 2; ++frame) {
    roll(5);
    view.ball_m = world.ball().position_m;
    track.see(view);
  }
  const Vec2 predicted = track.in(1.0);
  roll(100);
  EXPECT_NEAR(world.ball().position_m.x, predicted.x, 0.25);
  EXPECT_NEAR(world.ball().position_m.y, predicted.y, 0.25);
}

TEST(Chaser, IsWhoHasTheBallFirst) {
  TeamView view = home_view();
  view.ball_m = {-1.8, 1.0};
  BallTrack ball;
  ball.see(view);
  const auto interceptions = interceptions_of(view, ball);
  EXPECT_LT(interceptions[1].time_s, interceptions[2].time_s);
  EXPECT_EQ(chaser_of(interceptions, ball.now(), nobody), 1U);
}

TEST(Chaser, IsNobodyWhoMayNotMove) {
  TeamView view = home_view();
  view.ball_m = {-1.8, 1.0};
  view.own[1].active = false;
  BallTrack ball;
  ball.see(view);
  EXPECT_NE(chaser_of(interceptions_of(view, ball), ball.now(), nobody), 1U);
}

TEST(Chaser, StaysTheSameIfAnotherIsAboutAsNear) {
  std::array<Interception, robots_a_team> interceptions;
  interceptions.fill({.ball = {}, .time_s = 1.0});
  interceptions[3].time_s = 0.5;
  interceptions[4].time_s = 0.55;
  EXPECT_EQ(chaser_of(interceptions, {}, nobody), 3U);
  EXPECT_EQ(chaser_of(interceptions, {}, 4), 4U);
  interceptions[4].time_s = 0.65;
  EXPECT_EQ(chaser_of(interceptions, {}, 4), 3U);
}

TEST(Chaser, IsAForwardAheadAndADefenderBehindIfTheyAreAboutAsNear) {
  std::array<Interception, robots_a_team> interceptions;
  interceptions.fill({.ball = {}, .time_s = 1.0});
  interceptions[1].time_s = 0.6;
  EXPECT_EQ(chaser_of(interceptions, {0.0, 0.0}, nobody), 1U);
  EXPECT_EQ(chaser_of(interceptions, {1.0, 0.0}, nobody), 3U);
  interceptions[1].time_s = 1.3;
  interceptions[2].time_s = 1.4;
  EXPECT_EQ(chaser_of(interceptions, {-1.0, 0.0}, nobody), 3U);
  EXPECT_EQ(chaser_of(interceptions, {-2.0, 0.0}, nobody), 1U);
}

TEST(MadeSane, LeavesNothingThatIsNoPlace) {
  TeamView view = home_view();
  view.own[1].pose = {std::numeric_limits<double>::quiet_NaN(), 1e9,
                      -std::numeric_limits<double>::infinity()};
  view.ball_m = {1.0, -11.0};
  const TeamView sane = made_sane(view);
  EXPECT_EQ(sane.own[1].pose, Pose{});
  EXPECT_EQ(sane.ball_m, (Vec2{1.0, 0.0}));
  EXPECT_EQ(sane.own[2].pose, view.own[2].pose);
}

}  // namespace
}  // namespace striker::sil
