// SPDX-License-Identifier: Apache-2.0
// Letters of a serial line: only whole, valid lines become frames, and those come back as they are written.
#include "firmware/ports/bare_metal/slcan.hpp"

#include "tests/fuzz/support/bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace striker;
  bare_metal::SlcanReader reader;
  for (std::size_t i = 0; i < size; ++i) {
    can::Frame frame;
    if (!reader.take(static_cast<char>(data[i]), frame)) {
      continue;
    }
    fuzz::require(data[i] == '\r', "a frame ends with its line");
    fuzz::require(frame.id <= 0x7FF && frame.length <= 8, "a frame is one of classic CAN 2.0A");
    const bare_metal::SlcanLine line = bare_metal::slcan_line(frame);
    bare_metal::SlcanReader second;
    can::Frame again;
    bool ended = false;
    for (std::size_t letter = 0; letter < line.length; ++letter) {
      fuzz::require(!ended, "a line is one frame");
      ended = second.take(line.text[letter], again);
    }
    fuzz::require(ended && again == frame, "a written frame reads as itself");
  }
  return 0;
}
