// SPDX-License-Identifier: Apache-2.0
// A line of a candump log (can-utils, `candump -L`; python-can and SavvyCAN write the same):
//
//   (1700000000.012345) vcan0 050#1122334455667788
//
// stamp in seconds, interface, and a frame: three hexadecimal digits of identifier, or eight for an extended one,
// '#' and the data, or '#R' and a length for a remote frame, or '##', a digit of flags and the data of CAN FD. A
// direction may follow, as `candump -x` writes it.
#pragma once

#include <cstdint>
#include <string_view>
#include <variant>

#include "firmware/can/frame.hpp"

namespace striker::host {

enum class LoggedKind : std::uint8_t { data, extended, remote, fd, error };

struct CandumpLine {
  std::int64_t stamp_us = 0;
  std::string_view interface;  // in the line that was parsed
  LoggedKind kind = LoggedKind::data;
  can::Frame frame;  // of the kind `data` alone
};

// The line without its end, or what is wrong with it.
[[nodiscard]] std::variant<CandumpLine, const char*> parse_candump_line(std::string_view line);

}  // namespace striker::host
