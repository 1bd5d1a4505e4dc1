// SPDX-License-Identifier: Apache-2.0
// What an operator sends: arm, disarm, clear, and the emergency stop.
#pragma once

#include "firmware/can/layout.hpp"

namespace striker::can {

enum class Mode : std::uint8_t { disarm = 0, arm = 1, clear = 2 };

inline constexpr std::array<std::string_view, 3> mode_names = {"disarm", "arm", "clear"};
inline constexpr auto mode_values = named_values(mode_names);
static_assert(last_of(mode_values) == static_cast<std::int32_t>(Mode::clear));

inline constexpr std::array<std::string_view, 1> stop_source_names = {"operator"};
inline constexpr auto stop_source_values = named_values(stop_source_names);

struct EmergencyStop {
  std::int32_t source = 0;  // who pressed it; every source stops
};

template <>
inline constexpr auto layout<EmergencyStop> =
    Layout<EmergencyStop, 1>{.info = {.name = "EmergencyStop",
                                      .id = 0x010,
                                      .length = 2,
                                      .sender = Node::operator_,
                                      .data_id = 0x5A10,
                                      .comment = "Latches the emergency stop fault: torque 0.",
                                      .traffic = on_events(10)},
                             .signals = {{{.name = "source",
                                           .field = &EmergencyStop::source,
                                           .first_bit = 12,
                                           .bits = 4,
                                           .maximum = 15,
                                           .values = stop_source_values}}}};

struct ModeCommand {
  std::int32_t mode = 0;  // Mode
};

template <>
inline constexpr auto layout<ModeCommand> =
    Layout<ModeCommand, 1>{.info = {.name = "ModeCommand",
                                    .id = 0x040,
                                    .length = 2,
                                    .sender = Node::operator_,
                                    .data_id = 0x5A40,
                                    .comment = "Arm, disarm, or clear the latched fault.",
                                    .traffic = on_events(10)},
                           .signals = {{{.name = "mode",
                                         .field = &ModeCommand::mode,
                                         .first_bit = 12,
                                         .bits = 4,
                                         .maximum = last_of(mode_values),
                                         .values = mode_values}}}};

}  // namespace striker::can
