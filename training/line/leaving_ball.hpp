// SPDX-License-Identifier: Apache-2.0
// How the ball leaves a robot that met it on its line: what the aimed kick pays for. The collision is the fast world's
// own, and nothing of it depends on what came before.
#pragma once

#include <limits>

#include "sil/world/world.hpp"
#include "training/line/conditions.hpp"
#include "training/line/line_state.hpp"

namespace striker::training {

// What both wheels are set to from the contact's step on: a decision that is late acts after some steps, and until then
// the ones before it do.
struct Push {
  double set_point_m_s = 0.0;
  double last_set_point_m_s = 0.0;
  double one_before_m_s = 0.0;
  int late_steps = 0;

  [[nodiscard]] constexpr double at(int step) const {
    const int left = late_steps - step;
    return left <= 0 ? set_point_m_s : left <= steps_per_decision ? last_set_point_m_s : one_before_m_s;
  }
};

// The ball's velocity 100 ms after the step whose collision test finds the contact; both states are those before it.
// Some 10 us.
[[nodiscard]] sil::Vec2 leaving_ball_m_s(const Bodies& bodies, const LineState& robot,
                                         const sil::BallState& ball, const Push& push);

// What the episode has paid before the contact.
struct Waited {
  double reward_a_decision = 0.0;
  int decisions = 0;
};

// What the aimed kick pays in all. What cannot be more than `to_beat` may be told as anything up to that: the bound takes a
// thousandth of the time.
[[nodiscard]] double aimed_contact_reward(const Bodies& bodies, const LineState& robot,
                                          const sil::BallState& ball, const Push& push, const Waited& waited,
                                          double to_beat = -std::numeric_limits<double>::infinity());

// Hardly more than that, wherever on the line the robot meets the ball; and the speed below which it is hardly more than
// `reward`. Measured, not proved: of the forward's well-paid contacts one in 100 gets up to 0.3 more
// (tests/training/line/leaving_ball_test.cpp), a defender's up to 1.1, and so do balls that are faster than 3 m/s. What is found
// by this bound is itself a lower bound.
[[nodiscard]] double most_aimed_reward(const Bodies& bodies, double robot_speed_m_s,
                                       const sil::BallState& ball, const Waited& waited);
[[nodiscard]] double least_speed_for_m_s(const Bodies& bodies, double reward, const sil::BallState& ball,
                                         const Waited& waited);

}  // namespace striker::training
