// SPDX-License-Identifier: Apache-2.0
// A frame as a line of a candump log (candump -L): what writes one shares this.
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cstddef>
#include <string_view>

#include "sil/bus/stamped_frame.hpp"

namespace striker::sil {

using CandumpText = fmt::basic_memory_buffer<char, 64>;

// Appends "(0000000012.345000) vcan0 050#1122334455667788", with its end of line.
inline void append_line(CandumpText& text, std::size_t robot, const StampedFrame& stamped) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  const can::Frame& frame = stamped.frame;
  const std::int64_t stamp_us = stamped.received_ns / 1000;
  fmt::format_to(fmt::appender(text), FMT_COMPILE("({:010}.{:06}) vcan{} {:03X}#"), stamp_us / 1'000'000,
                 stamp_us % 1'000'000, robot, frame.id);
  for (std::size_t byte = 0; byte < frame.length; ++byte) {
    text.push_back(digits[frame.data[byte] >> 4U]);
    text.push_back(digits[frame.data[byte] & 0xFU]);
  }
  text.push_back('\n');
}

}  // namespace striker::sil
