// SPDX-License-Identifier: Apache-2.0
// Emergency stops have a socket of their own: which identifiers it receives, and which are left for the other.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/can/messages.hpp"

namespace striker::linux_port {

inline constexpr std::array stop_identifiers = {can::layout<can::EmergencyStop>.info.id};

[[nodiscard]] inline std::vector<std::uint16_t> all_but_stops(std::span<const std::uint16_t> identifiers) {
  std::vector<std::uint16_t> others(identifiers.begin(), identifiers.end());
  std::erase(others, stop_identifiers.front());
  return others;
}

}  // namespace striker::linux_port
