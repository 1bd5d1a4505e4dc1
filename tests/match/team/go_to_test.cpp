// SPDX-License-Identifier: Apache-2.0
// The go-to against seven vectors computed from the published formulas (AI World Cup examples ae937e6; the second
// limiter: wcg_ai_soccer_2020 c619e20), to the four digits that they are known to.
#include "sil/match/team/go_to.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "sil/match/team/plane.hpp"

namespace striker::sil {
namespace {

constexpr double pi = std::numbers::pi;

struct Vector {
  Vec2 target;
  double heading_rad;
  GoToGains gains;
  double top_m_s;
  SpeedOrder ratio;       // first limiter
  SpeedOrder difference;  // second one, which has no `full`
};

void expect_near(SpeedOrder is, SpeedOrder expected, double within = 5e-5) {
  EXPECT_NEAR(is.left_m_s, expected.left_m_s, within);
  EXPECT_NEAR(is.right_m_s, expected.right_m_s, within);
}

TEST(GoTo, AgreesWithThePublishedOne) {
  constexpr SpeedOrder none = {99.0, 99.0};
  const Vector vectors[] = {
      {{1.0, 0.0}, 0.0, {1.4, 3.5, 0.4}, 2.55, {2.55, 2.55}, {2.55, 2.55}},
      {{0.2, 0.1}, 0.0, {1.4, 3.5, 0.6}, 2.55, {1.3715, 1.6831}, {1.3715, 1.6831}},
      {{0.2, 0.4}, 0.0, {1.4, 3.0, 0.8}, 2.55, {0.5936, 2.55}, {0.2353, 2.55}},
      {{0.0, 0.5}, 0.0, {1.4, 3.5, 0.4}, 2.1, {-0.6283, 0.6283}, {-0.6283, 0.6283}},
      {{-0.5, 0.05}, 0.0, {1.4, 3.5, 0.4}, 2.1, {-2.1, -2.0596}, {-2.1, -2.0553}},
      {{0.0, 0.05}, pi / 2.0, {1.4, 5.0, 0.4, true}, 1.8, {1.8, 1.8}, none},
      {{1.5, 0.5}, 0.0, {1.4, 5.0, 0.4, true}, 2.55, {2.4694, 2.55}, none},
  };
  for (const Vector& vector : vectors) {
    SCOPED_TRACE(testing::Message() << vector.target.x << ", " << vector.target.y);
    const Pose robot = {0.0, 0.0, vector.heading_rad};
    expect_near(go_to(robot, vector.target, vector.gains, vector.top_m_s, ReverseSteering::published),
                vector.ratio);
    if (vector.difference != none) {
      const SpeedOrder free = wheels_to(robot, vector.target, vector.gains, ReverseSteering::published);
      expect_near(limited_in_difference(free, vector.top_m_s), vector.difference);
    }
  }
}

// Aside of 40 degrees the nearer it is the sharper it turns; else 9 of 90, up to 5 m.
TEST(GoTo, TurnsByDistance) {
  const auto ninetieths = [](double distance, double angle_rad) {
    const Vec2 target = {distance * std::cos(angle_rad), distance * std::sin(angle_rad)};
    const SpeedOrder wheels = wheels_to({}, target, {1.0, 3.5, 0.5}, ReverseSteering::corrected);
    return 90.0 * (wheels.right_m_s - wheels.left_m_s) / 2.0 / (0.5 * 4.0 * angle_rad);
  };
  const std::pair<double, double> expected[] = {{5.5, 17.0}, {1.1, 17.0},  {0.9, 19.0}, {0.6, 19.0},
                                                {0.4, 21.0}, {0.25, 23.0}, {0.15, 25.0}};
  for (const auto& [distance, share] : expected) {
    EXPECT_NEAR(ninetieths(distance, radians(60.0)), share, 1e-9) << distance;
    EXPECT_NEAR(ninetieths(distance, radians(41.0)), share, 1e-9) << distance;
    EXPECT_NEAR(ninetieths(distance, radians(39.0)), distance < 5.0 ? 9.0 : 17.0, 1e-9) << distance;
  }
}

// The target is behind, a little to the robot's left: backwards it has to turn clockwise, the left wheel less back than
// the right one.
TEST(GoTo, CorrectedSteersTheRightWayInReverse) {
  constexpr Vec2 behind = {-0.5, 0.05};
  const SpeedOrder published = go_to({}, behind, {}, 2.1, ReverseSteering::published);
  const SpeedOrder corrected = go_to({}, behind, {}, 2.1, ReverseSteering::corrected);
  EXPECT_LT(published.left_m_s, published.right_m_s);
  EXPECT_LT(corrected.right_m_s, corrected.left_m_s);
  expect_near(corrected, {published.right_m_s, published.left_m_s}, 1e-12);
}

TEST(GoTo, CorrectedIsThePublishedOneAhead) {
  for (const Vec2 target : {Vec2{1.0, 0.3}, Vec2{0.2, -0.4}, Vec2{0.05, 0.02}}) {
    EXPECT_EQ(go_to({}, target, {}, 2.1, ReverseSteering::published),
              go_to({}, target, {}, 2.1, ReverseSteering::corrected));
  }
}

// Half a second of a robot that drives as it is told and begins tail first, 20 degrees off.
TEST(GoTo, CorrectedComesNearerInReverse) {
  const auto heading_error_rad = [](ReverseSteering reverse) {
    Pose robot = {0.0, 0.0, radians(-20.0)};
    constexpr Vec2 target = {-3.0, 0.0};
    for (int step = 0; step < 10; ++step) {
      const SpeedOrder wheels = go_to(robot, target, {}, 2.1, reverse);
      const double ahead_m = 0.05 * (wheels.left_m_s + wheels.right_m_s) / 2.0;
      robot.heading_rad += 0.05 * (wheels.right_m_s - wheels.left_m_s) / 0.14;
      robot.x_m += ahead_m * std::cos(robot.heading_rad);
      robot.y_m += ahead_m * std::sin(robot.heading_rad);
    }
    return std::abs(wrapped_rad(bearing_rad(place_of(robot), target) + pi - robot.heading_rad));
  };
  EXPECT_LT(heading_error_rad(ReverseSteering::corrected), radians(12.0));
  EXPECT_GT(heading_error_rad(ReverseSteering::published), radians(40.0));
}

// 85 degrees and more off it turns on the spot, and `full` does not count.
TEST(GoTo, TurnsOnTheSpotToWhatIsAside) {
  const SpeedOrder wheels = go_to({}, {0.0, -0.5}, {1.4, 5.0, 0.4, true}, 2.1, ReverseSteering::corrected);
  expect_near(wheels, {0.4 * pi / 2.0, -0.4 * pi / 2.0}, 1e-12);
}

TEST(GoTo, IsMirroredByAMirror) {
  for (const double heading : {0.3, 1.4, 2.0, 3.0}) {
    const SpeedOrder left = go_to({0.1, 0.2, heading}, {-0.7, 1.1}, {}, 2.1, ReverseSteering::corrected);
    const SpeedOrder right = go_to({0.1, -0.2, -heading}, {-0.7, -1.1}, {}, 2.1, ReverseSteering::corrected);
    EXPECT_EQ(left.left_m_s, right.right_m_s);
    EXPECT_EQ(left.right_m_s, right.left_m_s);
  }
}

TEST(TurnTo, TurnsFrontOrBackWhicheverIsNearer) {
  expect_near(turn_to({0.0, 0.0, 0.5}, 1.0, 2.1), {-0.2, 0.2}, 1e-12);
  expect_near(turn_to({0.0, 0.0, 0.5}, 0.5 + radians(94.0), 2.1), {-0.4 * radians(94.0), 0.4 * radians(94.0)},
              1e-12);
  expect_near(turn_to({0.0, 0.0, 0.5}, 0.5 + radians(96.0), 2.1), {0.4 * radians(84.0), -0.4 * radians(84.0)},
              1e-12);
  expect_near(turn_to({0.0, 0.0, -3.0}, 3.0, 2.1), {0.4 * (2.0 * pi - 6.0), -0.4 * (2.0 * pi - 6.0)}, 1e-12);
}

TEST(WheelLimiter, KeepsRatioOrDifference) {
  EXPECT_EQ(limited_in_ratio({1.0, 4.0}, 2.0), (SpeedOrder{0.5, 2.0}));
  EXPECT_EQ(limited_in_ratio({-4.0, 1.0}, 2.0), (SpeedOrder{-2.0, 0.5}));
  EXPECT_EQ(limited_in_ratio({0.5, 1.0}, 2.0), (SpeedOrder{0.5, 1.0}));
  EXPECT_EQ(limited_in_ratio({0.5, 1.0}, 2.0, true), (SpeedOrder{1.0, 2.0}));
  EXPECT_EQ(limited_in_difference({1.0, 4.0}, 2.0), (SpeedOrder{-1.0, 2.0}));
  EXPECT_EQ(limited_in_difference({-4.0, -1.0}, 2.0), (SpeedOrder{-2.0, 1.0}));
  EXPECT_EQ(limited_in_difference({0.5, -1.0}, 2.0), (SpeedOrder{0.5, -1.0}));
}

TEST(WheelLimiter, SaysStandToWhatIsNoNumber) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {nan, infinity, -infinity}) {
    EXPECT_EQ(limited_in_ratio({1.0, value}, 2.0), SpeedOrder{});
    EXPECT_EQ(limited_in_ratio({value, 1.0}, 2.0), SpeedOrder{});
    EXPECT_EQ(limited_in_difference({1.0, value}, 2.0), SpeedOrder{});
    EXPECT_EQ(limited_in_difference({value, 1.0}, 2.0), SpeedOrder{});
    EXPECT_EQ(go_to({value, 0.0, 0.0}, {1.0, 0.0}, {}, 2.0, ReverseSteering::corrected), SpeedOrder{});
  }
  EXPECT_EQ(limited_in_ratio({}, 2.0, true), SpeedOrder{});
}

}  // namespace
}  // namespace striker::sil
