// SPDX-License-Identifier: Apache-2.0
// Frames as lines of a serial CAN adapter, and back; what is no frame is ignored.
#include "firmware/ports/bare_metal/slcan.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace striker::bare_metal {
namespace {

// The frames that a reader makes of a text.
std::vector<can::Frame> read_all(SlcanReader& reader, std::string_view text) {
  std::vector<can::Frame> frames;
  can::Frame frame;
  for (const char letter : text) {
    if (reader.take(letter, frame)) {
      frames.push_back(frame);
    }
  }
  return frames;
}

TEST(Slcan, EveryFrameComesBack) {
  std::mt19937 random(1);
  SlcanReader reader;
  for (int i = 0; i < 2'000; ++i) {
    can::Frame frame{.id = static_cast<std::uint16_t>(random() & 0x7FFU),
                     .length = static_cast<std::uint8_t>(random() % 9),
                     .data = {}};
    for (std::size_t byte = 0; byte < frame.length; ++byte) {
      frame.data[byte] = static_cast<std::uint8_t>(random());
    }
    const SlcanLine line = slcan_line(frame);
    const auto frames = read_all(reader, std::string_view(line.text.data(), line.length));
    ASSERT_EQ(frames.size(), 1U);
    ASSERT_EQ(frames[0], frame);
  }
}

TEST(Slcan, IsWrittenAsAdaptersWriteIt) {
  const SlcanLine line = slcan_line({.id = 0x05A, .length = 2, .data = {0xAB, 0x01}});
  EXPECT_EQ(std::string(line.text.data(), line.length), "t05A2AB01\r");
}

TEST(Slcan, WhatIsNoFrameIsIgnoredAndTheNextIsRead) {
  for (const char* text :
       {"\r", "V1013\r", "t\r", "t05A\r", "t05A2AB\r", "t05A2AB0102\r", "t05A9\r", "t8002AB01\r",
        "t05A2AG01\r", "T0000005A2AB01\r", "t05A8ABABABABABABABABABABABABABAB\r"}) {
    SlcanReader reader;
    EXPECT_EQ(read_all(reader, text).size(), 0U) << text;
    EXPECT_EQ(read_all(reader, "t0101FF\r").size(), 1U) << text;
  }
}

}  // namespace
}  // namespace striker::bare_metal
