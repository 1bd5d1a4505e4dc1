// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/estimation/angle.hpp"

#include <array>

namespace striker::core {

namespace {

// atan(2^-i) in units of 2^-32 of the circle.
constexpr std::array<std::int32_t, 16> step_angles = {
    536870912, 316933406, 167458907, 85004756, 42667331, 21354465, 10679838, 5340245,
    2670163,   1335087,   667544,    333772,   166886,   83443,    41722,    20861};

// 1 / (product of sqrt(1 + 2^-2i)), i = 0 to 15, in Q31: undoes the growth that the steps cause.
constexpr std::int64_t inverse_gain_q31 = 1304065748;

constexpr std::int32_t quarter_turn = 1 << 30;

constexpr std::int32_t undo_gain(std::int32_t grown) {
  return static_cast<std::int32_t>((grown * inverse_gain_q31 + (std::int64_t{1} << 30)) >> 31);
}

// All ones for a negative number, else 0: chooses a sign without a branch.
constexpr std::int32_t sign_mask(std::int32_t value) {
  return value >> 31;
}

constexpr std::int32_t negate_if(std::int32_t mask, std::int32_t value) {
  return (value ^ mask) - mask;
}

constexpr std::int32_t wrapped_sum(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}

}  // namespace

Vector rotate(Vector vector, BinaryAngle angle) {
  // CORDIC converges within 99 degrees: turn by half the circle first where the angle is beyond a quarter.
  std::int32_t rest = static_cast<std::int32_t>(static_cast<std::uint32_t>(angle) << 16U);
  const bool beyond = rest > quarter_turn || rest < -quarter_turn;
  const std::int32_t flip = -static_cast<std::int32_t>(beyond);
  rest = wrapped_sum(rest, flip & (-quarter_turn * 2));
  std::int32_t x = negate_if(flip, vector.x);
  std::int32_t y = negate_if(flip, vector.y);
  for (std::size_t i = 0; i < step_angles.size(); ++i) {
    const std::int32_t backward = sign_mask(rest);
    const std::int32_t turn_x = negate_if(backward, y >> i);
    const std::int32_t turn_y = negate_if(backward, x >> i);
    x -= turn_x;
    y += turn_y;
    rest -= negate_if(backward, step_angles[i]);
  }
  return {undo_gain(x), undo_gain(y)};
}

BinaryAngle direction_of(Vector vector) {
  if (vector.x == 0 && vector.y == 0) {
    return 0;
  }
  const std::int32_t flip = sign_mask(vector.x);
  std::int32_t x = negate_if(flip, vector.x);
  std::int32_t y = negate_if(flip, vector.y);
  std::int32_t angle = flip & (-quarter_turn * 2);
  for (std::size_t i = 0; i < step_angles.size(); ++i) {
    const std::int32_t below = sign_mask(y);
    const std::int32_t turn_x = negate_if(below, y >> i);
    const std::int32_t turn_y = negate_if(below, x >> i);
    x += turn_x;
    y -= turn_y;
    angle = wrapped_sum(angle, negate_if(below, step_angles[i]));
  }
  return wrap_angle(wrapped_sum(angle, 1 << 15) >> 16);
}

}  // namespace striker::core
