// SPDX-License-Identifier: Apache-2.0
// A DBC file from anywhere is read, or refused with one line that names it; what was read is frames that can be.
#include <stdexcept>
#include <string_view>

#include "sil/budget/dbc_reader.hpp"
#include "tests/fuzz/support/bytes.hpp"

namespace {

using namespace striker;

void require_frame(const sil::BusMessage& message) {
  const sil::FrameFormat& format = message.format;
  fuzz::require(message.id <= (format.extended ? 0x1FFFFFFFU : 0x7FFU), "an identifier has its bits");
  fuzz::require(message.bytes >= 0 && message.bytes <= (format.fd ? 64 : 8),
                "a frame has its format's length");
  fuzz::require(format.fd || !format.bit_rate_switch, "classic CAN keeps its bit rate");
  fuzz::require(
      message.period_ns > 0 && message.distance_ns > 0 && message.deadline_ns > 0 && message.burst > 0,
      "a message's times are positive");
  fuzz::require(message.distance_ns <= message.period_ns, "frames come no closer than their distance");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const sil::DbcOptions options{.default_distance_ms = size % 2 == 0 ? 0 : 10,
                                .has_data_bitrate = size % 3 != 0};
  try {
    const auto messages = sil::read_dbc(text, "fuzz.dbc", options);
    for (std::size_t i = 0; i < messages.size(); ++i) {
      require_frame(messages[i]);
      fuzz::require(i == 0 || sil::arbitration_rank(messages[i - 1].id, messages[i - 1].format.extended) <
                                  sil::arbitration_rank(messages[i].id, messages[i].format.extended),
                    "messages come in the order of priority");
    }
  } catch (const std::runtime_error& error) {
    const std::string_view what = error.what();
    fuzz::require(what.starts_with("fuzz.dbc: ") && what.find('\n') == std::string_view::npos,
                  "an error is one line that names its file");
  }
  return 0;
}
