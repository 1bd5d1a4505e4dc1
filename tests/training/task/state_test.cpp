// SPDX-License-Identifier: Apache-2.0
// The RCS state: what the corrected equations promise, and that the printed ones break it.
#include "training/task/state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace striker::training {
namespace {

constexpr double pi = std::numbers::pi;

Observation some_observation(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  std::uniform_real_distribution<double> speed(-3.0, 3.0);
  std::uniform_real_distribution<double> angle(-pi, pi);
  return {.robot = {place(random), place(random), angle(random)},
          .robot_velocity_m_s = {speed(random), speed(random)},
          .ball = {{place(random), place(random)}, {speed(random), speed(random)}}};
}

sil::Vec2 turned(sil::Vec2 v, double angle) {
  return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y};
}

// The same situation elsewhere on the field: turned about the origin, then shifted.
Observation moved(const Observation& seen, double angle, sil::Vec2 shift) {
  const sil::Vec2 robot = turned({seen.robot.x_m, seen.robot.y_m}, angle);
  const sil::Vec2 ball = turned(seen.ball.position_m, angle);
  return {.robot = {robot.x + shift.x, robot.y + shift.y, wrap_angle_rad(seen.robot.heading_rad + angle)},
          .robot_velocity_m_s = turned(seen.robot_velocity_m_s, angle),
          .ball = {{ball.x + shift.x, ball.y + shift.y}, turned(seen.ball.velocity_m_s, angle)}};
}

double greatest_difference(const RcsState& a, const RcsState& b) {
  return std::max({std::abs(a.ball_x_m - b.ball_x_m), std::abs(a.ball_y_m - b.ball_y_m),
                   std::abs(a.robot_speed_m_s - b.robot_speed_m_s), std::abs(a.ball_vx_m_s - b.ball_vx_m_s),
                   std::abs(a.ball_vy_m_s - b.ball_vy_m_s),
                   std::abs(wrap_angle_rad(a.ball_angle_rad - b.ball_angle_rad))});
}

TEST(State, CorrectedIsTheSameEverywhereOnTheField) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-5.0, 5.0);
  for (int i = 0; i < 10'000; ++i) {
    const Observation here = some_observation(random);
    const Observation there = moved(here, shift(random), {shift(random), shift(random)});
    ASSERT_LT(
        greatest_difference(rcs_state(here, Equations::corrected), rcs_state(there, Equations::corrected)),
        1e-9);
  }
}

TEST(State, PrintedDependsOnThePlace) {
  std::mt19937 random(2);
  const Observation here = some_observation(random);
  const Observation there = moved(here, 0.0, {1.0, 0.0});
  const RcsState a = rcs_state(here, Equations::printed);
  const RcsState b = rcs_state(there, Equations::printed);
  // The translation goes into the velocity: one metre becomes one metre per second.
  EXPECT_NEAR(std::hypot(a.ball_vx_m_s - b.ball_vx_m_s, a.ball_vy_m_s - b.ball_vy_m_s), 1.0, 1e-9);
  EXPECT_NEAR(a.ball_x_m, b.ball_x_m, 1e-9);
}

TEST(State, PrintedSpeedKnowsNoBackward) {
  Observation forward;
  forward.robot_velocity_m_s = {2.0, 0.0};
  Observation backward;
  backward.robot_velocity_m_s = {-2.0, 0.0};
  EXPECT_EQ(rcs_state(forward, Equations::printed).robot_speed_m_s, 4.0);
  EXPECT_EQ(rcs_state(backward, Equations::printed).robot_speed_m_s, 4.0);
  EXPECT_EQ(rcs_state(forward, Equations::corrected).robot_speed_m_s, 2.0);
  EXPECT_EQ(rcs_state(backward, Equations::corrected).robot_speed_m_s, -2.0);
}

TEST(State, OnlyTheCorrectedAngleWraps) {
  Observation seen;
  seen.robot.heading_rad = -3.0;
  seen.ball.velocity_m_s = {-1.0, 0.1};
  const double difference = std::atan2(0.1, -1.0) + 3.0;
  EXPECT_NEAR(rcs_state(seen, Equations::printed).ball_angle_rad, difference, 1e-12);
  EXPECT_NEAR(rcs_state(seen, Equations::corrected).ball_angle_rad, difference - 2.0 * pi, 1e-12);
}

TEST(State, AnglesWrapIntoTheHalfOpenCircle) {
  EXPECT_EQ(wrap_angle_rad(pi), pi);
  EXPECT_EQ(wrap_angle_rad(-pi), pi);
  for (int i = -2000; i < 2000; ++i) {
    const double angle = 0.01 * i;
    const double wrapped = wrap_angle_rad(angle);
    ASSERT_GT(wrapped, -pi);
    ASSERT_LE(wrapped, pi);
    ASSERT_NEAR(std::cos(wrapped), std::cos(angle), 1e-12);
    ASSERT_NEAR(std::sin(wrapped), std::sin(angle), 1e-12);
  }
}

TEST(State, ABallAtRestHasADirection) {
  Observation seen;
  seen.robot.heading_rad = 1.0;
  seen.ball.velocity_m_s = {0.0, 0.99 * rest_speed_m_s};
  EXPECT_EQ(rcs_state(seen, Equations::corrected).ball_angle_rad, 0.0);
  seen.ball.velocity_m_s = {0.0, 1.01 * rest_speed_m_s};
  EXPECT_NEAR(rcs_state(seen, Equations::corrected).ball_angle_rad, pi / 2 - 1.0, 1e-12);
}

StateInputs all_inputs() {
  StateInputs inputs = rcs_inputs();
  inputs.push_back({.element = Element::decisions_left});
  inputs.push_back({.element = Element::robot_speed, .decisions_ago = 1});
  inputs.push_back({.element = Element::ball_y, .decisions_ago = 4});
  return inputs;
}

Features features_at(const StateInputs& inputs, const Observation& seen) {
  History history;
  history.begin({.rcs = rcs_state(seen, Equations::corrected), .field = seen, .decisions_left = 30});
  sil::Random dummies(1, 1, 1);
  Features features(inputs.size());
  write_features(inputs, history, false, dummies, features);
  return features;
}

TEST(State, TheMirrorIsTheMirroredWorld) {
  std::mt19937 random(3);
  const StateInputs inputs = all_inputs();
  for (int i = 0; i < 1'000; ++i) {
    Observation seen = some_observation(random);
    const Features here = features_at(inputs, seen);
    seen.robot.y_m *= -1.0;
    seen.robot.heading_rad *= -1.0;
    seen.robot_velocity_m_s.y *= -1.0;
    seen.ball.position_m.y *= -1.0;
    seen.ball.velocity_m_s.y *= -1.0;
    ASSERT_LT((here.cwiseProduct(mirror_factors(inputs)) - features_at(inputs, seen)).norm(), 1e-5F);
  }
}

// The controller's integers say the same as the features, to half a count.
TEST(State, RawUnitsSayTheSame) {
  std::mt19937 random(4);
  const StateInputs inputs = all_inputs();
  for (int i = 0; i < 10'000; ++i) {
    const Observation seen = some_observation(random);
    History history;
    history.begin({.rcs = rcs_state(seen, Equations::corrected), .field = seen, .decisions_left = 17});
    const RawState raw = raw_state(inputs, history);
    ASSERT_EQ(raw.size(), inputs.size());
    sil::Random dummies(1, 1, 1);
    Features features(inputs.size());
    write_features(inputs, history, false, dummies, features);
    features[5] = features[5] >= 1.0F - 1.0F / 65536.0F ? -1.0F : features[5];  // pi and -pi are one count
    ASSERT_LT((features_of(inputs, raw) - features).cwiseAbs().maxCoeff(), 3e-4F);
  }
}

TEST(State, RawUnitsAreTheFirmwares) {
  History history;
  history.begin({.rcs = {.ball_x_m = 1.0, .robot_speed_m_s = -2.55, .ball_angle_rad = pi},
                 .field = {},
                 .decisions_left = 40});
  EXPECT_EQ(raw_state(all_inputs(), history), (RawState{1'000'000, 0, -2550, 0, 0, -32768, 40, -2550, 0}));
}

// Before the first decision everything was as at the first.
TEST(State, HistoryLooksBack) {
  History history;
  history.begin({.rcs = {.ball_x_m = 1.0}, .field = {}, .decisions_left = 40});
  for (int i = 0; i < greatest_look_back; ++i) {
    EXPECT_EQ(history.ago(i).rcs.ball_x_m, 1.0);
  }
  for (int i = 2; i < 10; ++i) {
    history.add({.rcs = {.ball_x_m = 1.0 * i}, .field = {}, .decisions_left = 41 - i});
    for (int ago = 0; ago <= greatest_look_back; ++ago) {
      EXPECT_EQ(history.ago(ago).rcs.ball_x_m, std::max(1, i - ago));
    }
  }
}

TEST(State, DummiesAreNoiseOfTheirOwnStream) {
  const StateInputs inputs(2, {.element = Element::dummy});
  sil::Random stream(1, 2, 3);
  sil::Random same(1, 2, 3);
  Features first(2);
  Features again(2);
  write_features(inputs, {}, false, stream, first);
  write_features(inputs, {}, false, same, again);
  EXPECT_EQ(first, again);
  EXPECT_NE(first[0], first[1]);
  write_features(inputs, {}, false, stream, again);
  EXPECT_NE(first, again);
  EXPECT_LE(again.cwiseAbs().maxCoeff(), 1.0F);
}

TEST(State, TheAcsIsTheFieldsView) {
  std::mt19937 random(5);
  const Observation seen = some_observation(random);
  const Features features = features_at(acs_inputs(), seen);
  ASSERT_EQ(features.size(), 10);
  EXPECT_NEAR(features[0], seen.robot.x_m / 4.0, 1e-6);
  EXPECT_NEAR(features[5], seen.ball.position_m.x / 4.0, 1e-6);
  EXPECT_NEAR(features[9], std::atan2(seen.ball.velocity_m_s.y, seen.ball.velocity_m_s.x) / pi, 1e-6);
}

}  // namespace
}  // namespace striker::training
