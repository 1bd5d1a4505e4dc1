// SPDX-License-Identifier: Apache-2.0
// A line from anywhere is read as a frame, or refused with a reason; a data frame that is written again as candump
// does reads as itself.
#include <cstdio>
#include <string>

#include "firmware/host/can/candump_line.hpp"
#include "tests/fuzz/support/bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace striker;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto parsed = host::parse_candump_line(text);
  const auto* const line = std::get_if<host::CandumpLine>(&parsed);
  if (line == nullptr) {
    fuzz::require(!std::string_view(std::get<const char*>(parsed)).empty(), "a refusal has a reason");
    return 0;
  }
  fuzz::require(line->frame.id <= 0x7FF && line->frame.length <= 8, "a frame is one of classic CAN 2.0A");
  fuzz::require(line->stamp_us >= 0 && !line->interface.empty(), "a line has a stamp and an interface");
  if (line->kind != host::LoggedKind::data) {
    return 0;
  }
  std::array<char, 64> written{};
  std::snprintf(written.data(), written.size(), "(%010lld.%06lld) can0 %03X#",
                static_cast<long long>(line->stamp_us / 1'000'000),
                static_cast<long long>(line->stamp_us % 1'000'000), static_cast<unsigned>(line->frame.id));
  std::string again = written.data();
  for (std::size_t byte = 0; byte < line->frame.length; ++byte) {
    std::snprintf(written.data(), written.size(), "%02X", static_cast<unsigned>(line->frame.data[byte]));
    again += written.data();
  }
  const auto second = host::parse_candump_line(again);
  const auto* const same = std::get_if<host::CandumpLine>(&second);
  fuzz::require(same != nullptr && same->kind == line->kind && same->frame == line->frame &&
                    same->stamp_us == line->stamp_us,
                "a written line reads as itself");
  return 0;
}
