// SPDX-License-Identifier: Apache-2.0
// What an operator sends: the emergency stop, mode commands, and how the controller asks back.
//
// The safe direction takes one frame: an emergency stop and a disarm act on any correct frame, whatever its
// counter, and a repeated one does no harm. Arming and clearing take two: the request (challenge 0), which the
// controller answers with a Challenge of its own, and within `consent_ticks` the same command with that number.
// A challenge is good once. `renew` prolongs being armed and needs no answer: alone it moves nothing.
//
// Random bytes: a frame passes the CRC with probability 2^-8, and confirms the one open challenge with 2^-31 of
// those: 2^-39 a frame (1.8e-12), while one is open.
#pragma once

#include "firmware/can/layout.hpp"

namespace striker::can {

enum class Mode : std::uint8_t { disarm = 0, arm = 1, clear = 2, renew = 3 };

inline constexpr std::array<std::string_view, 4> mode_names = {"disarm", "arm", "clear", "renew"};
inline constexpr auto mode_values = named_values(mode_names);
static_assert(last_of(mode_values) == static_cast<std::int32_t>(Mode::renew));

inline constexpr std::array<std::string_view, 1> stop_source_names = {"operator"};
inline constexpr auto stop_source_values = named_values(stop_source_names);

struct EmergencyStop {
  std::int32_t source = 0;  // who pressed it; every source stops
};

template <>
inline constexpr auto layout<EmergencyStop> =
    Layout<EmergencyStop, 1>{.info = {.name = "EmergencyStop",
                                      .id = moved(0x010),
                                      .length = 2,
                                      .sender = Node::operator_,
                                      .data_ids = 1,
                                      .comment = "Latches the emergency stop fault: torque 0.",
                                      .traffic = on_events(10)},
                             .signals = {{{.name = "source",
                                           .field = &EmergencyStop::source,
                                           .first_bit = 12,
                                           .bits = 4,
                                           .maximum = 15,
                                           .values = stop_source_values}}}};

struct ModeCommand {
  std::int32_t mode = 0;       // Mode
  std::int32_t challenge = 0;  // 0: a request; else the controller's challenge, which this confirms
};

template <>
inline constexpr auto layout<ModeCommand> =
    Layout<ModeCommand, 2>{.info = {.name = "ModeCommand",
                                    .id = moved(0x040),
                                    .length = 6,
                                    .sender = Node::operator_,
                                    .data_ids = 4,
                                    .comment = "Disarm, renew; ask to arm or to clear, and confirm it.",
                                    .traffic = on_events(10)},
                           .signals = {{{.name = "mode",
                                         .field = &ModeCommand::mode,
                                         .first_bit = 12,
                                         .bits = 4,
                                         .maximum = last_of(mode_values),
                                         .values = mode_values},
                                        {.name = "challenge",
                                         .field = &ModeCommand::challenge,
                                         .first_bit = 16,
                                         .bits = 31,
                                         .maximum = greatest_31_bits}}}};

struct Challenge {
  std::int32_t mode = 0;       // Mode that was asked for: arm or clear
  std::int32_t challenge = 0;  // never 0
};

template <>
inline constexpr auto layout<Challenge> =
    Layout<Challenge, 2>{.info = {.name = "Challenge",
                                  .id = moved(0x090),
                                  .length = 6,
                                  .sender = Node::controller,
                                  .data_ids = 11,
                                  .comment = "What a request has to be confirmed with.",
                                  .traffic = on_events(10)},
                         .signals = {{{.name = "mode",
                                       .field = &Challenge::mode,
                                       .first_bit = 12,
                                       .bits = 4,
                                       .maximum = last_of(mode_values),
                                       .values = mode_values},
                                      {.name = "challenge",
                                       .field = &Challenge::challenge,
                                       .first_bit = 16,
                                       .bits = 31,
                                       .minimum = 1,
                                       .maximum = greatest_31_bits}}}};

}  // namespace striker::can
