// SPDX-License-Identifier: Apache-2.0
// The ways to the ten controllers of a match: in this process, or one CAN interface a robot.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>

#include "sil/bus/controller_link.hpp"
#include "sil/bus/socketcan_link.hpp"
#include "sil/match/referee/referee_frame.hpp"

namespace striker::sil {

using MatchLinks = std::array<std::unique_ptr<ControllerLink>, robots_in_match>;

// Forwards have the built-in policy; goalkeepers and defenders, which are too slow for it, have none.
[[nodiscard]] MatchLinks links_in_process();

// `prefix` and the robot's number name its interface: vcan0 to vcan9. Throws std::runtime_error that names one that
// cannot be opened.
[[nodiscard]] MatchLinks links_on_can(const std::string& prefix, const SocketCanOptions& options);

}  // namespace striker::sil
