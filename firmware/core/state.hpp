// SPDX-License-Identifier: Apache-2.0
// The controller's states and faults, as they stand on the bus and in every report.
//
//   boot       the first tick after reset; left by itself
//   self_test  one golden vector a tick; left for standby when all have passed
//   standby    torque 0; waits for an arm request, with fresh pictures and wheel speeds
//   active     the only state that drives; left by a disarm, a stop of the port, or a fault
//   fault      torque 0, with every fault since the last clear, the first one apart; left by a confirmed clear
//              alone, which is refused while a cause lasts
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
  emergency_stop = 2,    // a stop was pressed; survives a restart of logical time
  vision_lost = 3,       // active, and no complete picture within `vision_timeout_ticks`
  wheel_state_lost = 4,  // active, and no wheel speeds within `wheel_timeout_ticks`
  sync_lost = 5,         // lockstep: the simulator's ticks stopped
  overrun = 6,           // the port missed more ticks than its limit
  overspeed = 7,         // a wheel beyond its greatest speed was to be driven further
  command_rejected = 8,  // the final check refused the command
  bus_off = 9,           // the CAN controller left the bus
  wheel_state_invalid = 10,  // wheel states come, but repeated, out of order, wrong, or from two senders
  vision_invalid = 11,       // the same of pictures
  operator_invalid = 12,     // wrong frames under an operator's identifiers, again and again
  sync_invalid = 13,         // lockstep: logical time stood still, went back or leapt; two simulators
  wheels_implausible = 14,   // wheel speeds that no wheel has, or that go against the torque
  vision_implausible = 15,   // pictures in which robot or ball are where they cannot be
  motion_mismatch = 16,      // wheels and camera tell of different motions
  drives_cut = 17,           // the drives hold the torque at 0 though they are told to move
  dead_man = 18,             // armed for longer than `armed_limit_ticks` without a renewal
  second_controller = 19,    // another controller talks on this bus
  frames_lost = 20,          // the port could not keep what it received
  state_corrupt = 21,        // the controller's memory changed by itself; only a reboot clears it
  policy_corrupt = 22,       // the policy's weights changed; only a reboot clears it
  gate_blocked = 23,         // the command gate stopped a command without a cause
  clock_invalid = 24,        // the port's tick went back
  processor_exception = 25,  // the processor had to reset itself; its record tells why
  watchdog = 26,             // the hardware watchdog reset the processor
};

inline constexpr std::array<std::string_view, 5> state_names = {"boot", "self_test", "standby", "active",
                                                                "fault"};
inline constexpr std::array<std::string_view, 27> fault_names = {"none",
                                                                 "self_test_failed",
                                                                 "emergency_stop",
                                                                 "vision_lost",
                                                                 "wheel_state_lost",
                                                                 "sync_lost",
                                                                 "overrun",
                                                                 "overspeed",
                                                                 "command_rejected",
                                                                 "bus_off",
                                                                 "wheel_state_invalid",
                                                                 "vision_invalid",
                                                                 "operator_invalid",
                                                                 "sync_invalid",
                                                                 "wheels_implausible",
                                                                 "vision_implausible",
                                                                 "motion_mismatch",
                                                                 "drives_cut",
                                                                 "dead_man",
                                                                 "second_controller",
                                                                 "frames_lost",
                                                                 "state_corrupt",
                                                                 "policy_corrupt",
                                                                 "gate_blocked",
                                                                 "clock_invalid",
                                                                 "processor_exception",
                                                                 "watchdog"};

static_assert(state_names.size() == static_cast<std::size_t>(State::fault) + 1, "a state without a name");
static_assert(fault_names.size() == static_cast<std::size_t>(Fault::watchdog) + 1, "a fault without a name");

// Several faults at once: bit (code) of each. Bit 0 is never set.
using Faults = std::uint32_t;
static_assert(fault_names.size() <= 31, "a set of faults travels in 31 bits");

inline constexpr Faults known_faults = (Faults{1} << fault_names.size()) - 2;

[[nodiscard]] constexpr Faults set_of(Fault fault) {
  return fault == Fault::none ? 0 : Faults{1} << static_cast<unsigned>(fault);
}

[[nodiscard]] constexpr Faults set_if(bool condition, Fault fault) {
  return condition ? set_of(fault) : 0;
}

[[nodiscard]] constexpr std::string_view name_of(State state) {
  return state_names[static_cast<std::size_t>(state)];
}
[[nodiscard]] constexpr std::string_view name_of(Fault fault) {
  return fault_names[static_cast<std::size_t>(fault)];
}

}  // namespace striker::core
