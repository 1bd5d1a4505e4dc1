// SPDX-License-Identifier: Apache-2.0
// The controller's states and faults, as they stand on the bus and in every report.
//
//   boot       the first tick after reset; left by itself
//   self_test  one golden vector a tick; left for standby when all have passed
//   standby    torque 0; waits for an arm request, with fresh pictures and wheel speeds
//   active     the only state that drives; left by a disarm, a stop of the port, or a fault
//   fault      torque 0, with the first fault since the last clear; left by a clear request alone, which is
//              refused while the cause lasts
//
// The numbers are the protocol's: they are never given to something else.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace striker::core {

enum class State : std::uint8_t { boot = 0, self_test = 1, standby = 2, active = 3, fault = 4 };

enum class Fault : std::uint8_t {
  none = 0,
  self_test_failed = 1,  // a golden vector came out different, or the policy is not for this robot; only a
                         // reboot clears it
  emergency_stop = 2,    // a stop was pressed
  vision_lost = 3,       // active, and no complete picture within `vision_timeout_ticks`
  wheel_state_lost = 4,  // active, and no wheel speeds within `wheel_timeout_ticks`
  sync_lost = 5,         // lockstep: the simulator's ticks stopped
  overrun = 6,           // the port missed more ticks than its limit
  overspeed = 7,         // a wheel beyond its greatest speed was to be driven further
  command_rejected = 8,  // the final check refused the command
  bus_off = 9,           // the CAN controller left the bus
};

inline constexpr std::array<std::string_view, 5> state_names = {"boot", "self_test", "standby", "active",
                                                                "fault"};
inline constexpr std::array<std::string_view, 10> fault_names = {
    "none",      "self_test_failed", "emergency_stop", "vision_lost",      "wheel_state_lost",
    "sync_lost", "overrun",          "overspeed",      "command_rejected", "bus_off"};

static_assert(state_names.size() == static_cast<std::size_t>(State::fault) + 1, "a state without a name");
static_assert(fault_names.size() == static_cast<std::size_t>(Fault::bus_off) + 1, "a fault without a name");

[[nodiscard]] constexpr std::string_view name_of(State state) {
  return state_names[static_cast<std::size_t>(state)];
}
[[nodiscard]] constexpr std::string_view name_of(Fault fault) {
  return fault_names[static_cast<std::size_t>(fault)];
}

}  // namespace striker::core
