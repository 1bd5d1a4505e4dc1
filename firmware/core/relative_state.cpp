#include "core/relative_state.hpp"

#include <algorithm>

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

// um / (mm/s) is ms. Places up to 134 m away fit; the vision frames tell of 24 m at most.
void find_crossing(RelativeState& state) {
  const auto [vx, vy] = state.ball_velocity_mm_s;
  const std::int32_t time = vy == 0 ? crossing_time_limit_16th_ms
                                    : std::clamp(-state.ball_um.y * 16 / vy, -crossing_time_limit_16th_ms,
                                                 crossing_time_limit_16th_ms);
  const std::int64_t way_um = (std::int64_t{vx} * time) >> 4;
  state.crossing_time_16th_ms = time;
  state.crossing_x_um = static_cast<std::int32_t>(
      std::clamp<std::int64_t>(state.ball_um.x + way_um, -crossing_x_limit_um, crossing_x_limit_um));
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
  find_crossing(state);
  return state;
}

std::int32_t element_of(const RelativeState& state, StateElement element) {
  switch (element) {
    case StateElement::ball_x:
      return state.ball_um.x;
    case StateElement::ball_y:
      return state.ball_um.y;
    case StateElement::robot_speed:
      return state.robot_speed_mm_s;
    case StateElement::ball_vx:
      return state.ball_velocity_mm_s.x;
    case StateElement::ball_vy:
      return state.ball_velocity_mm_s.y;
    case StateElement::ball_angle:
      return state.ball_angle;
    case StateElement::decisions_left:
      return state.decisions_left;
    case StateElement::crossing_time:
      return state.crossing_time_16th_ms;
    case StateElement::crossing_x:
      return state.crossing_x_um;
  }
  return 0;
}

}  // namespace striker::core
