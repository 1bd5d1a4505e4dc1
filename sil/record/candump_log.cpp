// SPDX-License-Identifier: Apache-2.0
#include "sil/record/candump_log.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <string_view>

namespace striker::sil {

void CandumpLog::end_tick(const Snapshot& snapshot) {
  for (std::size_t robot = 0; robot < snapshot.robots.size(); ++robot) {
    for (const StampedFrame& stamped : snapshot.robots[robot].frames) {
      write(robot, stamped);
    }
  }
  file_.flush();
}

void CandumpLog::write(std::size_t robot, const StampedFrame& stamped) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  const can::Frame& frame = stamped.frame;
  const std::int64_t stamp_us = stamped.received_ns / 1000;
  fmt::basic_memory_buffer<char, 64> line;
  fmt::format_to(fmt::appender(line), FMT_COMPILE("({:010}.{:06}) vcan{} {:03X}#"), stamp_us / 1'000'000,
                 stamp_us % 1'000'000, robot, frame.id);
  for (std::size_t byte = 0; byte < frame.length; ++byte) {
    line.push_back(digits[frame.data[byte] >> 4U]);
    line.push_back(digits[frame.data[byte] & 0xFU]);
  }
  line.push_back('\n');
  file_.write({line.data(), line.size()});
}

}  // namespace striker::sil
