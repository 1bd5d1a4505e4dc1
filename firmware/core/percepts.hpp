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
#include "firmware/core/state.hpp"

namespace striker::core {

// A picture without news for longer than this is stale, and so are wheel speeds.
inline constexpr std::uint32_t vision_timeout_ticks = 150;
inline constexpr std::uint32_t wheel_timeout_ticks = 20;

// For how long an order is good, and how many numbers motions have.
inline constexpr std::uint32_t order_timeout_ticks = 150;
inline constexpr std::uint8_t motion_numbers = 4;

// A camera numbers its pictures 0 to 15, and again; robot and ball of one picture share the number.
inline constexpr std::int32_t picture_numbers = 16;

struct RobotSighting {
  std::int32_t picture = 0;
  Vector position_um = {};
  BinaryAngle heading = 0;
  std::uint8_t age_ticks = 0;  // since it was received
};

struct BallSighting {
  std::int32_t picture = 0;
  Vector position_um = {};
  std::uint8_t age_ticks = 0;
};

// Of the rims, positive forward: as measured, or as a set-point.
struct WheelSpeeds {
  std::int32_t left_mm_s = 0;
  std::int32_t right_mm_s = 0;
  bool operator==(const WheelSpeeds&) const = default;
};

// What a team told the robot: wheel speeds, or a motion, of which there is the kick.
struct TeamOrder {
  bool is_motion = false;
  std::uint8_t age_ticks = 0;  // since it was received
  std::uint8_t number = 0;     // of the motion, below `motion_numbers`
  WheelSpeeds speeds = {};
};

// Whole words: they are part of the sealed state (seal.hpp).
enum class Order : std::uint32_t { none, arm, clear };

struct Confirmation {
  Order order = Order::none;
  std::uint32_t challenge = 0;
};

// What an operator sent in this tick; of several of a kind the last one counts.
struct Requests {
  bool disarm = false;  // at once
  bool renew = false;   // being armed goes on
  Order asked = Order::none;
  Confirmation confirmed;
};

// What the receiver found wrong with a message as a whole; its data were not taken.
struct InvalidMessages {
  bool wheels = false;     // wheel states come, but not in sequence, or wrong
  bool vision = false;     // the same of pictures
  bool operators = false;  // wrong frames under an operator's identifier
  bool orders = false;     // the team's orders come, but not in sequence, or wrong
};

struct Percepts {
  std::optional<RobotSighting> robot;
  std::optional<BallSighting> ball;
  std::optional<WheelSpeeds> wheels;
  std::uint8_t wheels_age_ticks = 0;  // since they were received
  bool drives_cut = false;            // the drives say that they hold the torque at 0; with `wheels`
  std::optional<TeamOrder> order;     // of the team
  bool emergency_stop = false;
  bool second_controller = false;  // a frame of another controller came
  InvalidMessages invalid;
  // After a disarm nothing from before it counts: the sightings above are later than the request.
  Requests requests;
};

// All that a step of the controller is given.
struct Inputs {
  std::uint32_t tick = 0;
  Percepts percepts;
  Faults port_faults = 0;  // what the port sees now: overrun, bus_off, sync_lost, ...
  bool stop = false;       // the port stops: to standby, with torque 0
};

}  // namespace striker::core
