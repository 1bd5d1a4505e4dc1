// SPDX-License-Identifier: Apache-2.0
// What the team `striker` does so that the rules of the match do not turn against it, and against jams.
#include "sil/match/team/striker/manners.hpp"

#include <gtest/gtest.h>

#include "tests/match/team/views.hpp"

namespace striker::sil {
namespace {

struct Scene {
  Scene() : view(home_view()) {}

  Situation now() {
    ball.see(view);
    return {.view = view, .ball = ball, .interceptions = {}, .chaser = chaser};
  }

  TeamView view;
  BallTrack ball;
  std::size_t chaser = 3;
};

TEST(GoalAreaWatch, SendsOutWhoIsNotAtTheBall) {
  Scene scene;
  GoalAreaWatch watch;
  scene.view.own[4].pose = {3.6, 0.5, 0.0};
  EXPECT_TRUE(watch.has_to_leave(scene.now(), 4));
  scene.view.own[4].pose = {3.6, 0.75, 0.0};
  EXPECT_FALSE(watch.has_to_leave(scene.now(), 4));
  scene.view.own[4].pose = {3.4, 0.5, 0.0};
  EXPECT_FALSE(watch.has_to_leave(scene.now(), 4));
}

TEST(GoalAreaWatch, LeavesTheChaserThereForLessThanASecond) {
  Scene scene;
  GoalAreaWatch watch;
  scene.view.own[3].pose = {3.6, 0.5, 0.0};
  scene.view.ball_m = {3.7, 0.5};
  int frames = 0;
  while (!watch.has_to_leave(scene.now(), 3) && frames < 100) {
    ++frames;
  }
  EXPECT_GT(frames, 8);
  EXPECT_LT(frames, 16);  // and 4 frames to leave
  scene.view.own[3].pose = {3.0, 0.5, 0.0};
  EXPECT_FALSE(watch.has_to_leave(scene.now(), 3));
  scene.view.own[3].pose = {3.6, 0.5, 0.0};
  EXPECT_FALSE(watch.has_to_leave(scene.now(), 3));  // counts anew
}

TEST(WayOut, KeepsThirdAttackersOut) {
  Scene scene;
  for (const std::size_t id : {1U, 3U, 4U}) {
    scene.view.own[id].pose = {3.2, 0.2 * static_cast<double>(id), 0.0};
  }
  EXPECT_FALSE(way_out(scene.now(), 3));  // the chaser
  EXPECT_FALSE(way_out(scene.now(), 1));
  const auto out = way_out(scene.now(), 4);
  ASSERT_TRUE(out);
  EXPECT_LT(out->x, 2.8);
  EXPECT_EQ(out->y, scene.view.own[4].pose.y_m);
  scene.chaser = 4;
  EXPECT_FALSE(way_out(scene.now(), 4));
  EXPECT_TRUE(way_out(scene.now(), 3));
  scene.view.own[1].active = false;  // does not count
  EXPECT_FALSE(way_out(scene.now(), 3));
}

TEST(WayOut, KeepsFourthDefendersOut) {
  Scene scene;
  scene.view.own[0].pose = {-3.8, 0.0, 0.0};
  for (const std::size_t id : {1U, 2U, 3U}) {
    scene.view.own[id].pose = {-3.2, 0.2 * static_cast<double>(id), 0.0};
  }
  EXPECT_FALSE(way_out(scene.now(), 0));
  EXPECT_FALSE(way_out(scene.now(), 3));
  EXPECT_FALSE(way_out(scene.now(), 1));
  const auto out = way_out(scene.now(), 2);
  ASSERT_TRUE(out);
  EXPECT_GT(out->x, -2.8);
}

TEST(WayOut, StopsWhoComesNear) {
  Scene scene;
  scene.view.own[1].pose = {3.2, 0.0, 0.0};
  scene.view.own[3].pose = {3.2, 0.3, 0.0};
  scene.view.own[4].pose = {2.9, 0.3, 0.0};
  EXPECT_TRUE(way_out(scene.now(), 4));
  scene.view.own[4].pose = {2.7, 0.3, 0.0};
  EXPECT_FALSE(way_out(scene.now(), 4));
  scene.view.own[4].pose = {3.2, 1.2, 0.0};
  EXPECT_FALSE(way_out(scene.now(), 4));
}

TEST(Unstick, BacksOffAfterAWhileAndForAWhile) {
  Scene scene;
  Unstick unstick;
  const SpeedOrder told = {1.0, 1.0};
  int before = 0;
  while (unstick.changed(scene.now(), 3, told) == told && before < 100) {
    ++before;
  }
  EXPECT_GE(before, 10);
  EXPECT_LE(before, 16);
  int during = 1;
  while (unstick.changed(scene.now(), 3, told) != told && during < 100) {
    ++during;
  }
  EXPECT_GE(during, 7);
  EXPECT_LE(during, 9);
}

TEST(Unstick, LeavesAloneWhoMovesOrStandsAsTold) {
  Scene scene;
  Unstick unstick;
  for (int frame = 0; frame < 100; ++frame) {
    EXPECT_EQ(unstick.changed(scene.now(), 3, {}), SpeedOrder{});
    scene.view.own[4].pose.x_m += 0.02;
    EXPECT_EQ(unstick.changed(scene.now(), 4, {1.0, 1.0}), (SpeedOrder{1.0, 1.0}));
  }
}

// The ball is at its left side, which goes ahead when it turns clockwise.
TEST(Unstick, SweepsTheBallAhead) {
  Scene scene;
  Unstick unstick;
  scene.view.own[3].pose = {1.0, 1.0, 0.0};
  scene.view.ball_m = {1.05, 1.12};
  SpeedOrder wheels = {1.0, 1.0};
  for (int frame = 0; frame < 20 && wheels == (SpeedOrder{1.0, 1.0}); ++frame) {
    wheels = unstick.changed(scene.now(), 3, {1.0, 1.0});
  }
  EXPECT_EQ(wheels, (SpeedOrder{2.55, -2.55}));
}

}  // namespace
}  // namespace striker::sil
