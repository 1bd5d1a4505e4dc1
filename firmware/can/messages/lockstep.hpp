// SPDX-License-Identifier: Apache-2.0
// Lockstep: a simulator's tick begins with Sync and ends with the controller's EndOfTick. Neither is on a bus
// that runs by the clock.
#pragma once

#include "firmware/can/layout.hpp"

namespace striker::can {

struct Sync {
  std::int32_t tick = 0;  // logical time, 1 ms, low 31 bits; 0 restarts the controller
};

template <>
inline constexpr auto layout<Sync> =
    Layout<Sync, 1>{.info = {.name = "Sync",
                             .id = moved(0x030),
                             .length = 6,
                             .sender = Node::simulator,
                             .period_ms = 1,
                             .data_ids = 3,
                             .comment = "Lockstep: the controller steps once for each."},
                    .signals = {{{.name = "tick",
                                  .field = &Sync::tick,
                                  .first_bit = 16,
                                  .bits = 31,
                                  .maximum = greatest_31_bits,
                                  .unit = "ms"}}}};

struct EndOfTick {
  std::int32_t tick = 0;  // of the Sync that it answers, low 31 bits
};

template <>
inline constexpr auto layout<EndOfTick> =
    Layout<EndOfTick, 1>{.info = {.name = "EndOfTick",
                                  .id = 0x7F0,
                                  .length = 6,
                                  .sender = Node::controller,
                                  .period_ms = 1,
                                  .data_ids = 10,
                                  .comment = "Lockstep: the answer to a Sync is complete.",
                                  .traffic = awaited_by_its_receiver()},
                         .signals = {{{.name = "tick",
                                       .field = &EndOfTick::tick,
                                       .first_bit = 16,
                                       .bits = 31,
                                       .maximum = greatest_31_bits,
                                       .unit = "ms"}}}};

}  // namespace striker::can
