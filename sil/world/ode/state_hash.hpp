// SPDX-License-Identifier: Apache-2.0
// One number for the state of all bodies.
#pragma once

#include <cstdint>
#include <span>

#include "sil/world/ode/ode_world.hpp"
#include "sil/world/ode/robot.hpp"

namespace striker::sil {

// FNV-1a of 64 bits (Fowler, Noll, Vo; RFC 9923) over the bytes of each double, lowest first: position,
// quaternion, linear and angular velocity of every body and wheel, whether the robot is on the field, and last
// the ball.
[[nodiscard]] std::uint64_t state_hash(std::span<const Robot> robots, const Ball& ball);

}  // namespace striker::sil
