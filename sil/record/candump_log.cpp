#include "sil/record/candump_log.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <string_view>

namespace striker::sil {

void write_candump(host::AtomicFile& log, std::int64_t stamp_us, const can::Frame& frame) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  fmt::basic_memory_buffer<char, 64> line;
  fmt::format_to(fmt::appender(line), FMT_COMPILE("({:010}.{:06}) vcan0 {:03X}#"), stamp_us / 1'000'000,
                 stamp_us % 1'000'000, frame.id);
  for (std::size_t byte = 0; byte < frame.length; ++byte) {
    line.push_back(digits[frame.data[byte] >> 4U]);
    line.push_back(digits[frame.data[byte] & 0xFU]);
  }
  line.push_back('\n');
  log.write({line.data(), line.size()});
}

}  // namespace striker::sil
