// SPDX-License-Identifier: Apache-2.0
// slcan, the ASCII protocol of serial CAN adapters (LAWICEL CAN232 manual; Linux's slcan driver): a data
// frame is 't', three digits of identifier, one of length, two for each byte, all hexadecimal, and a carriage
// return. Other lines (adapter commands and replies) are ignored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "firmware/can/frame.hpp"

namespace striker::bare_metal {

class SlcanReader {
 public:
  // 't', identifier and length. No shorter line is looked at.
  static constexpr std::size_t shortest = 5;

  // Takes one letter. True if it ended a frame, which is in `frame` then.
  [[nodiscard]] constexpr bool take(char letter, can::Frame& frame) {
    if (letter != '\r') {
      if (count_ < line_.size()) {
        line_[count_] = letter;
      }
      count_ += static_cast<std::size_t>(count_ <= line_.size());
      return false;
    }
    const std::string_view line(line_.data(), count_ <= line_.size() ? count_ : 0);
    count_ = 0;
    return line.size() >= shortest && parse(line, frame);
  }

 private:
  static constexpr int digit_of(char letter) {
    return letter >= '0' && letter <= '9'   ? letter - '0'
           : letter >= 'A' && letter <= 'F' ? letter - 'A' + 10
           : letter >= 'a' && letter <= 'f' ? letter - 'a' + 10
                                            : -1;
  }

  // Apart: how many lines end in a poll bounds it (tools/step_bound/facts.toml).
  [[gnu::noinline]] static constexpr bool parse(std::string_view line, can::Frame& frame) {
    if (line[0] != 't') {
      return false;
    }
    std::string_view digits = line;
    digits.remove_prefix(1);
    for (const char letter : digits) {
      if (digit_of(letter) < 0) {
        return false;
      }
    }
    const auto digit = [&](std::size_t i) { return static_cast<unsigned>(digit_of(line[i])); };
    const unsigned id = digit(1) << 8U | digit(2) << 4U | digit(3);
    if (id > 0x7FF || digit(4) > 8 || line.size() != 5 + 2 * digit(4)) {
      return false;
    }
    frame = {.id = static_cast<std::uint16_t>(id), .length = static_cast<std::uint8_t>(digit(4)), .data = {}};
    for (std::size_t byte = 0; byte < frame.length; ++byte) {
      frame.data[byte] = static_cast<std::uint8_t>(digit(5 + 2 * byte) << 4U | digit(6 + 2 * byte));
    }
    return true;
  }

  std::array<char, 21> line_{};
  std::size_t count_ = 0;
};

struct SlcanLine {
  std::array<char, 22> text{};
  std::size_t length = 0;
};

[[nodiscard]] constexpr SlcanLine slcan_line(const can::Frame& frame) {
  SlcanLine line;
  const auto add = [&](unsigned nibble) { line.text[line.length++] = "0123456789ABCDEF"[nibble & 0xFU]; };
  line.text[line.length++] = 't';
  add(frame.id >> 8U);
  add(frame.id >> 4U);
  add(frame.id);
  add(frame.length);
  for (std::size_t byte = 0; byte < frame.length && byte < frame.data.size(); ++byte) {
    add(frame.data[byte] >> 4U);
    add(frame.data[byte]);
  }
  line.text[line.length++] = '\r';
  return line;
}

}  // namespace striker::bare_metal
