// SPDX-License-Identifier: Apache-2.0
// What the controller tells of itself: state and fault, decisions, timing, sign of life, version.
#pragma once

#include "firmware/can/layout.hpp"
#include "firmware/core/decision_clock.hpp"
#include "firmware/core/orders/standing_order.hpp"
#include "firmware/core/state.hpp"
#include "firmware/core/tick.hpp"

namespace striker::can {

inline constexpr auto state_values = named_values(core::state_names);
inline constexpr auto fault_values = named_values(core::fault_names);
inline constexpr auto order_state_values = named_values(core::order_state_names);
static_assert(last_of(order_state_values) == static_cast<std::int32_t>(core::OrderState::lapsed));

// In unsigned 16-bit measured fields: no measurement.
inline constexpr std::int32_t not_available = 0xFFFF;
inline constexpr std::array<NamedValue, 1> measured_values = {{{not_available, "not_available"}}};

struct FaultReport {
  std::int32_t code = 0;  // core::Fault; the first since the last clear
  std::int32_t tick = 0;  // when it was latched, low 31 bits
};

template <>
inline constexpr auto layout<FaultReport> =
    Layout<FaultReport, 2>{.info = {.name = "FaultReport",
                                    .id = moved(0x020),
                                    .length = 7,
                                    .sender = Node::controller,
                                    .period_ms = 100,
                                    .data_ids = 2,
                                    .comment = "At the fault, then while it is latched.",
                                    .traffic = on_changes(2, 2)},
                           .signals = {{{.name = "code",
                                         .field = &FaultReport::code,
                                         .first_bit = 16,
                                         .bits = 8,
                                         .maximum = last_of(fault_values),
                                         .values = fault_values},
                                        {.name = "tick",
                                         .field = &FaultReport::tick,
                                         .first_bit = 24,
                                         .bits = 31,
                                         .maximum = greatest_31_bits,
                                         .unit = "ms"}}}};

struct Status {
  std::int32_t state = 0;         // core::State
  std::int32_t fault = 0;         // core::Fault; the first since the last clear
  std::int32_t wrong_length = 0;  // frames ignored since boot, by reason; each stays at 255
  std::int32_t wrong_crc = 0;
  std::int32_t wrong_counter = 0;
  std::int32_t out_of_range = 0;
  std::int32_t vision_ready = 0;  // 1: two fresh pictures: the controller could be armed
  std::int32_t wheels_ready = 0;  // 1: the wheel speeds are fresh
  std::int32_t kick_over = 0;  // 1: armed, but the kick has had its decisions: the wheels are told to stand
  std::int32_t orders = 0;     // core::OrderState; 0: no team was heard since boot
};

template <>
inline constexpr auto layout<Status> = Layout<Status, 10>{
    .info = {.name = "Status",
             .id = moved(0x100),
             .length = 8,
             .sender = Node::controller,
             .period_ms = 10,
             .timeout_ms = 100,
             .data_ids = 9,
             .comment = "State, latched fault, ignored frames.",
             .traffic = on_changes(1, 3)},
    .signals = {
        {{.name = "state",
          .field = &Status::state,
          .first_bit = 12,
          .bits = 4,
          .maximum = last_of(state_values),
          .values = state_values},
         {.name = "fault",
          .field = &Status::fault,
          .first_bit = 16,
          .bits = 8,
          .maximum = last_of(fault_values),
          .values = fault_values},
         {.name = "wrong_length", .field = &Status::wrong_length, .first_bit = 24, .bits = 8, .maximum = 255},
         {.name = "wrong_crc", .field = &Status::wrong_crc, .first_bit = 32, .bits = 8, .maximum = 255},
         {.name = "wrong_counter",
          .field = &Status::wrong_counter,
          .first_bit = 40,
          .bits = 8,
          .maximum = 255},
         {.name = "out_of_range", .field = &Status::out_of_range, .first_bit = 48, .bits = 8, .maximum = 255},
         {.name = "vision_ready", .field = &Status::vision_ready, .first_bit = 56, .bits = 1, .maximum = 1},
         {.name = "wheels_ready", .field = &Status::wheels_ready, .first_bit = 57, .bits = 1, .maximum = 1},
         {.name = "kick_over", .field = &Status::kick_over, .first_bit = 58, .bits = 1, .maximum = 1},
         {.name = "orders",
          .field = &Status::orders,
          .first_bit = 59,
          .bits = 2,
          .maximum = last_of(order_state_values),
          .values = order_state_values}}}};

// What the gate holds back at present: bits of `Safety::limits`.
inline constexpr std::uint32_t limit_torque = 1U << 0U;
inline constexpr std::uint32_t limit_slew = 1U << 1U;
inline constexpr std::uint32_t limit_set_point = 1U << 2U;

struct Safety {
  std::int32_t limits = 0;       // limit_...: active in the last tick
  std::int32_t faults = 0;       // every fault since the last clear: bit (code) of core::Fault
  std::int32_t blocked = 0;      // commands that the gate did not let out since boot; stays at 255
  std::int32_t lost_frames = 0;  // that the port could not keep since boot; stays at 255
};

template <>
inline constexpr auto layout<Safety> = Layout<Safety, 4>{
    .info = {.name = "Safety",
             .id = moved(0x108),
             .length = 8,
             .sender = Node::controller,
             .period_ms = 100,
             .timeout_ms = 1000,
             .data_ids = 12,
             .comment = "Every latched fault, active limits, what the gate stopped.",
             .traffic = on_changes(1, 2)},
    .signals = {{{.name = "limits", .field = &Safety::limits, .first_bit = 12, .bits = 4, .maximum = 15},
                 {.name = "faults",
                  .field = &Safety::faults,
                  .first_bit = 16,
                  .bits = 31,
                  .maximum = greatest_31_bits},
                 {.name = "blocked", .field = &Safety::blocked, .first_bit = 48, .bits = 8, .maximum = 255},
                 {.name = "lost_frames",
                  .field = &Safety::lost_frames,
                  .first_bit = 56,
                  .bits = 8,
                  .maximum = 255}}}};

struct Decision {
  std::int32_t number = 0;  // since arming, or since the order that began the motion, low 16 bits
  std::int32_t action = 0;
  std::int32_t extrapolated = 0;  // 1: decided without a new picture
  std::int32_t best_q_256th = 0;  // Q of the action, in 1/256; saturates
  std::int32_t next_q_256th = 0;  // Q of the best other action
};

template <>
inline constexpr auto layout<Decision> = Layout<Decision, 5>{
    .info = {.name = "Decision",
             .id = moved(0x110),
             .length = 7,
             .sender = Node::controller,
             .period_ms = core::decision_period_ms,
             .comment = "What the Q network chose; a provisional choice waits for a late picture.",
             .traffic = on_changes(1, 3)},
    .signals = {
        {{.name = "number", .field = &Decision::number, .first_bit = 0, .bits = 16, .maximum = 65535},
         {.name = "action", .field = &Decision::action, .first_bit = 16, .bits = 4, .maximum = 15},
         {.name = "extrapolated", .field = &Decision::extrapolated, .first_bit = 20, .bits = 1, .maximum = 1},
         {.name = "best_q",
          .field = &Decision::best_q_256th,
          .first_bit = 24,
          .bits = 16,
          .is_signed = true,
          .minimum = -32768,
          .maximum = 32767,
          .scale = units::one_256th},
         {.name = "next_q",
          .field = &Decision::next_q_256th,
          .first_bit = 40,
          .bits = 16,
          .is_signed = true,
          .minimum = -32768,
          .maximum = 32767,
          .scale = units::one_256th}}}};

struct Timing {
  std::int32_t lateness_max_us = not_available;   // since the last timing frame
  std::int32_t execution_max_us = not_available;  // of one tick: receive, step, send
  std::int32_t overruns = not_available;          // ticks missed since boot; stays at 65534
  std::int32_t latency_max_us = not_available;    // from a frame's reception to the command that follows it
};

template <>
inline constexpr auto layout<Timing> =
    Layout<Timing, 4>{.info = {.name = "Timing",
                               .id = moved(0x120),
                               .length = 8,
                               .sender = Node::controller,
                               .period_ms = 100,
                               .comment = "The port's clock; not available in lockstep."},
                      .signals = {{{.name = "lateness_max",
                                    .field = &Timing::lateness_max_us,
                                    .first_bit = 0,
                                    .bits = 16,
                                    .maximum = 65535,
                                    .unit = "us",
                                    .values = measured_values},
                                   {.name = "execution_max",
                                    .field = &Timing::execution_max_us,
                                    .first_bit = 16,
                                    .bits = 16,
                                    .maximum = 65535,
                                    .unit = "us",
                                    .values = measured_values},
                                   {.name = "overruns",
                                    .field = &Timing::overruns,
                                    .first_bit = 32,
                                    .bits = 16,
                                    .maximum = 65535,
                                    .values = measured_values},
                                   {.name = "latency_max",
                                    .field = &Timing::latency_max_us,
                                    .first_bit = 48,
                                    .bits = 16,
                                    .maximum = 65535,
                                    .unit = "us",
                                    .values = measured_values}}}};

struct Heartbeat {
  std::int32_t uptime_ms = 0;  // ticks since boot, low 31 bits
};

template <>
inline constexpr auto layout<Heartbeat> =
    Layout<Heartbeat, 1>{.info = {.name = "Heartbeat",
                                  .id = 0x700,
                                  .length = 4,
                                  .sender = Node::controller,
                                  .period_ms = 100,
                                  .timeout_ms = 500,
                                  .comment = "The controller is alive."},
                         .signals = {{{.name = "uptime",
                                       .field = &Heartbeat::uptime_ms,
                                       .first_bit = 0,
                                       .bits = 31,
                                       .maximum = greatest_31_bits,
                                       .unit = "ms"}}}};

struct Version {
  std::int32_t protocol = 0;
  std::int32_t decision_period_ms = 0;
  std::int32_t policy_low = 0;  // the policy's identity, 32 bits in two halves
  std::int32_t policy_high = 0;
};

template <>
inline constexpr auto layout<Version> = Layout<Version, 4>{
    .info = {.name = "Version",
             .id = 0x710,
             .length = 6,
             .sender = Node::controller,
             .period_ms = 1000,
             .comment = "Protocol and policy."},
    .signals = {
        {{.name = "protocol", .field = &Version::protocol, .first_bit = 0, .bits = 8, .maximum = 255},
         {.name = "decision_period",
          .field = &Version::decision_period_ms,
          .first_bit = 8,
          .bits = 8,
          .maximum = 255,
          .unit = "ms"},
         {.name = "policy_low", .field = &Version::policy_low, .first_bit = 16, .bits = 16, .maximum = 65535},
         {.name = "policy_high",
          .field = &Version::policy_high,
          .first_bit = 32,
          .bits = 16,
          .maximum = 65535}}}};

}  // namespace striker::can
