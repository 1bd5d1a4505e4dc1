// SPDX-License-Identifier: Apache-2.0
// What the world of a match keeps to, measured from outside: from the poses after each tick and the field's plan alone.
//
// STRIKER_MATCHES=100 plays as many whole matches, each with another seed; without it a short one is played.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "sil/match/play/robot_kind.hpp"
#include "tests/match/play/plan_depth.hpp"
#include "tests/match/play/watched_match.hpp"

namespace striker::sil {
namespace {

struct Peaks {
  double speed_share = 0.0;  // of a robot's own limit
  double robot_wall_m = 0.0;
  double robot_robot_m = 0.0;
  double ball_wall_s = 0.0;  // depth by speed
  int not_finite = 0;
  int tips = 0;    // robots that began to lean by 36.9 degrees
  int fallen = 0;  // that the referee sent out for it
};

class PhysicsWatch final : public MatchObserver, public Observer {
 public:
  void frame(const MatchFrame& frame) override {
    out_ = frame.ruling.sent_out;
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      const bool leans = frame.robots[robot].up < 0.8;
      peaks.tips += leans && !leans_[robot] ? 1 : 0;
      leans_[robot] = leans;
    }
    for (const MatchEvent& event : frame.ruling.events) {
      peaks.fallen += event.kind == EventKind::sent_out && event.cause == Cause::fallen ? 1 : 0;
    }
  }

  void end_tick(const Snapshot& snapshot) override {
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      if (!out_[robot]) {
        see_robot(snapshot, robot);
      }
    }
    see_ball(snapshot.ball);
  }

  Peaks peaks;

 private:
  void see_robot(const Snapshot& snapshot, std::size_t robot) {
    const RobotSnapshot& one = snapshot.robots[robot];
    const double speed_m_s = std::hypot(one.velocity_m_s.x, one.velocity_m_s.y);
    if (!std::isfinite(one.pose.x_m + one.pose.y_m + one.pose.heading_rad + speed_m_s)) {
      ++peaks.not_finite;
      return;
    }
    if (leans_[robot]) {
      return;  // its plan is no square
    }
    const double limit_m_s = kind_of(robot).description->top_rim_speed_mm_s / 1e3;
    peaks.speed_share = std::max(peaks.speed_share, speed_m_s / limit_m_s);
    const Square square = square_of(one.pose);
    peaks.robot_wall_m = std::max(peaks.robot_wall_m, depth_in_walls_m(square));
    for (std::size_t other = robot + 1; other < robots_in_match; ++other) {
      if (!out_[other] && !leans_[other]) {
        const double depth_m = depth_of_squares_m(square, square_of(snapshot.robots[other].pose));
        peaks.robot_robot_m = std::max(peaks.robot_robot_m, depth_m);
      }
    }
  }

  void see_ball(const BallState& ball) {
    constexpr double slow_m_s = 0.5;  // below it a depth by speed says nothing
    const double speed_m_s = std::hypot(ball.velocity_m_s.x, ball.velocity_m_s.y);
    if (!std::isfinite(ball.position_m.x + ball.position_m.y + speed_m_s)) {
      ++peaks.not_finite;
      return;
    }
    const double depth_m = depth_in_walls_m(ball.position_m, ball_radius_m);
    peaks.ball_wall_s = std::max(peaks.ball_wall_s, depth_m / std::max(speed_m_s, slow_m_s));
  }

  RobotSet out_;
  RobotSet leans_;
};

TEST(MatchPhysics, KeepsToTheFieldAndToItsSpeeds) {
  const char* wanted = std::getenv("STRIKER_MATCHES");
  const int matches = wanted == nullptr ? 1 : static_cast<int>(std::strtol(wanted, nullptr, 10));
  ASSERT_GT(matches, 0);
  for (int i = 0; i < matches; ++i) {
    SCOPED_TRACE("seed " + std::to_string(100 + i));
    ShortMatch match({.teams = {"rules", "rules"},
                      .seed = static_cast<std::uint64_t>(100 + i),
                      .half_s = wanted == nullptr ? 30 : 300});
    PhysicsWatch watch;
    match.play({&watch}, {&watch});
    const Peaks& peaks = watch.peaks;
    if (wanted != nullptr) {
      std::printf(
          "seed %d: speed %.3f, robot-wall %.1f mm, robot-robot %.1f mm, ball-wall %.1f ms, %d tips, %d fallen\n",
          100 + i, peaks.speed_share, peaks.robot_wall_m * 1e3, peaks.robot_robot_m * 1e3,
          peaks.ball_wall_s * 1e3, peaks.tips, peaks.fallen);
      std::fflush(stdout);
    }
    EXPECT_EQ(peaks.not_finite, 0);
    EXPECT_LE(peaks.speed_share, 1.2);
    EXPECT_LE(peaks.robot_wall_m, 0.035);
    EXPECT_LE(peaks.robot_robot_m, 0.045);
    EXPECT_LE(peaks.ball_wall_s, 0.010);
    EXPECT_LE(peaks.tips, 6);
    EXPECT_LE(peaks.fallen, 1);
  }
}

}  // namespace
}  // namespace striker::sil
