// SPDX-License-Identifier: Apache-2.0
// A recorded run of the simulator, frame by frame: what went to the controller, and what it answered.
//
// The file (tests/ports/record_run.py makes it of a candump log): for each frame 11 bytes, identifier (16 bits,
// little endian), length, 8 bytes of data. Bit 15 of the identifier marks the controller's own frames; a
// tick's inputs end with its SYNC, and its answers follow.
#pragma once

#include <array>
#include <cstdint>

#include <algorithm>

#include "firmware/can/frame.hpp"
#include "tests/images/console.hpp"

namespace striker::images {

inline constexpr std::uint16_t from_controller = 0x8000;

struct RecordedFrame {
  bool answer = false;  // the controller's
  can::Frame frame;
};

class Recording {
 public:
  explicit Recording(const char* name) : file_(name) {}
  [[nodiscard]] bool is_open() const { return file_.is_open(); }

  [[nodiscard]] bool next(RecordedFrame& recorded) {
    std::array<std::uint8_t, 11> bytes{};
    if (!file_.read(bytes)) {
      return false;
    }
    const auto marked = static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8);
    recorded.answer = (marked & from_controller) != 0;
    recorded.frame.id = static_cast<std::uint16_t>(marked & ~from_controller);
    recorded.frame.length = bytes[2];
    std::copy(bytes.begin() + 3, bytes.end(), recorded.frame.data.begin());
    return true;
  }

 private:
  console::File file_;
};

}  // namespace striker::images
