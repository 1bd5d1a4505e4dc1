#include "bus/candump_log.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <string_view>

namespace striker::sil {

void write_candump(AtomicFile& log, std::uint32_t tick_ms, std::span<const can::Frame> frames) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  for (const can::Frame& frame : frames) {
    fmt::basic_memory_buffer<char, 64> line;
    fmt::format_to(fmt::appender(line), FMT_COMPILE("({:010}.{:03}000) vcan0 {:03X}#"), tick_ms / 1000,
                   tick_ms % 1000, frame.id);
    for (std::size_t byte = 0; byte < frame.length; ++byte) {
      line.push_back(digits[frame.data[byte] >> 4U]);
      line.push_back(digits[frame.data[byte] & 0xFU]);
    }
    line.push_back('\n');
    log.write({line.data(), line.size()});
  }
}

}  // namespace striker::sil
