// SPDX-License-Identifier: Apache-2.0
// What a viewer may ask of a run, and how it is written: one JSON object a message.
//
//   {"do": "pause"}   {"do": "run"}   {"do": "step", "ticks": 50}   {"do": "speed", "x": 0.1}   {"do": "speed", "x": "max"}
//   {"do": "restart", "seed": 7}   {"do": "stop"}   {"do": "stop", "robot": 3}
//   {"do": "fault", "robot": 0, "kind": "loss", "ms": 500}
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sil/fault/plan/fault_kinds.hpp"

namespace striker::sil {

enum class ViewAction : std::uint8_t { pause, run, step, speed, restart, stop, fault };

struct ViewCommand {
  ViewAction action = ViewAction::pause;
  std::uint32_t ticks = 1;                // step: 1 to 1000
  double speed = 1.0;                     // speed: times real time, 0.1 to 1000; 0: as fast as it goes
  std::uint64_t seed = 0;                 // restart
  std::optional<std::size_t> robot = {};  // stop: none is all of them; fault: which
  FaultKind kind = FaultKind::loss;       // fault
  std::uint32_t for_ms = 0;               // fault: 1 to 60000
};

inline constexpr std::size_t most_command_bytes = 256;
inline constexpr double least_view_speed = 0.1;
inline constexpr double greatest_view_speed = 1000.0;
inline constexpr std::size_t most_viewed_robots = 10;

// Nothing where the text is no such command: longer than `most_command_bytes`, another key or type, or out of range.
[[nodiscard]] std::optional<ViewCommand> parse_command(std::string_view text);

}  // namespace striker::sil
