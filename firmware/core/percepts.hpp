// SPDX-License-Identifier: Apache-2.0
// What the controller is told in a tick: the part of the world that a receiver took from the bus.
//
// Whoever fills this has checked it: protection, ranges and order are the receiver's business. Of several of
// a kind in one tick the last one counts. Coordinates are the field's (x towards the opponent's goal, y to
// the left, um); headings are binary angles, anticlockwise from +x.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/core/estimation/angle.hpp"

namespace striker::core {

// A picture without news for longer than this is stale, and so are wheel speeds.
inline constexpr std::uint32_t vision_timeout_ticks = 150;
inline constexpr std::uint32_t wheel_timeout_ticks = 20;

// A camera numbers its pictures 0 to 15, and again; robot and ball of one picture share the number.
inline constexpr std::int32_t picture_numbers = 16;

struct RobotSighting {
  std::int32_t picture = 0;
  Vector position_um = {};
  BinaryAngle heading = 0;
};

struct BallSighting {
  std::int32_t picture = 0;
  Vector position_um = {};
};

// Of the rims, positive forward: as measured, or as a set-point.
struct WheelSpeeds {
  std::int32_t left_mm_s = 0;
  std::int32_t right_mm_s = 0;
  bool operator==(const WheelSpeeds&) const = default;
};

// An operator's requests: each is set for the one tick in which it came.
struct Requests {
  bool arm = false;
  bool disarm = false;
  bool clear = false;
};

struct Percepts {
  std::optional<RobotSighting> robot;
  std::optional<BallSighting> ball;
  std::optional<WheelSpeeds> wheels;
  bool emergency_stop = false;
  // After a disarm nothing from before it counts: the sightings above are later than the request.
  Requests requests;
};

}  // namespace striker::core
