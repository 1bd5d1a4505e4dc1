// SPDX-License-Identifier: Apache-2.0
// A DBC file from anywhere is read, or refused with one line that names it; what was read has a response time, or
// an error of its own.
#include "sil/budget/dbc_reader.hpp"

#include <stdexcept>
#include <string_view>

#include "tests/fuzz/support/temporary_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace striker;
  const auto file = fuzz::file_of(data, size);
  try {
    for (const sil::BusMessage& message : sil::read_dbc(file, size % 2 == 0 ? 0 : 10)) {
      fuzz::require(message.id <= 0x7FF && message.bytes >= 0 && message.bytes <= 8,
                    "a message is classic CAN's");
      fuzz::require(
          message.period_ns > 0 && message.distance_ns > 0 && message.deadline_ns > 0 && message.burst > 0,
          "a message's times are positive");
      fuzz::require(message.distance_ns <= message.period_ns, "frames come no closer than their distance");
    }
  } catch (const std::runtime_error& error) {
    const std::string_view what = error.what();
    fuzz::require(what.starts_with(file.string()), "an error names its file");
  }
  return 0;
}
