// SPDX-License-Identifier: Apache-2.0
// Angles and rotations in integers: binary angles, and CORDIC (Volder 1959) for rotation and direction.
//
// A binary angle counts 2^16 to the full circle, so that adding and subtracting wrap by themselves. CORDIC
// takes 16 shift-and-add steps whatever its input, with no multiplication but one and no table of sines.
// Error: at most 4 counts of angle (0.022 degrees) for vectors longer than 10,000 units, and 2^-13 of a
// rotated vector's length plus 16 units (held by tests/core/angle_test.cpp).
#pragma once

#include <cstdint>

namespace striker::core {

using BinaryAngle = std::int16_t;

[[nodiscard]] constexpr BinaryAngle wrap_angle(std::int32_t counts) {
  return static_cast<BinaryAngle>(static_cast<std::uint16_t>(static_cast<std::uint32_t>(counts) & 0xFFFFU));
}

struct Vector {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

// Components up to 2^29 in magnitude.
[[nodiscard]] Vector rotate(Vector vector, BinaryAngle angle);

// The direction of the vector, anticlockwise from +x; of the null vector 0. Components up to 2^29.
[[nodiscard]] BinaryAngle direction_of(Vector vector);

}  // namespace striker::core
