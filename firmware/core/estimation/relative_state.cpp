// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/estimation/relative_state.hpp"

namespace striker::core {

namespace {

// Speeds are rotated with this many more bits, or the rotation's own error would show.
constexpr int guard_bits = 8;

constexpr std::int32_t drop_guard_bits(std::int32_t value) {
  return (value + (1 << (guard_bits - 1))) >> guard_bits;
}

constexpr bool at_rest(Vector velocity_mm_s) {
  const std::int64_t x = velocity_mm_s.x;
  const std::int64_t y = velocity_mm_s.y;
  return x * x + y * y < std::int64_t{rest_speed_mm_s} * rest_speed_mm_s;
}

}  // namespace

RelativeState relative_state(const Estimate& estimate) {
  const BinaryAngle back = wrap_angle(-estimate.heading);
  const Vector offset_um = {estimate.ball_um.x - estimate.robot_um.x,
                            estimate.ball_um.y - estimate.robot_um.y};
  const Vector velocity = rotate(
      {estimate.ball_velocity_mm_s.x * (1 << guard_bits), estimate.ball_velocity_mm_s.y * (1 << guard_bits)},
      back);
  RelativeState state;
  state.ball_um = rotate(offset_um, back);
  state.robot_speed_mm_s = estimate.robot_speed_mm_s;
  state.ball_velocity_mm_s = {drop_guard_bits(velocity.x), drop_guard_bits(velocity.y)};
  state.ball_angle = at_rest(estimate.ball_velocity_mm_s) ? BinaryAngle{0} : direction_of(velocity);
  return state;
}

std::int32_t element_of(const RelativeState& state, policy::StateElement element) {
  switch (element) {
    case policy::StateElement::ball_x:
      return state.ball_um.x;
    case policy::StateElement::ball_y:
      return state.ball_um.y;
    case policy::StateElement::robot_speed:
      return state.robot_speed_mm_s;
    case policy::StateElement::ball_vx:
      return state.ball_velocity_mm_s.x;
    case policy::StateElement::ball_vy:
      return state.ball_velocity_mm_s.y;
    case policy::StateElement::ball_angle:
      return state.ball_angle;
    case policy::StateElement::decisions_left:
      return state.decisions_left;
  }
  return 0;
}

}  // namespace striker::core
