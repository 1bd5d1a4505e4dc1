// SPDX-License-Identifier: Apache-2.0
// A frame's bits, against a second implementation by text: CRC by polynomial division, stuffing by search.
#include "sil/bus/frame_bits.hpp"

#include <gtest/gtest.h>

#include <bitset>
#include <string>

#include "sil/world/random.hpp"

namespace striker::sil {
namespace {

std::string binary(unsigned value, std::size_t bits) {
  return std::bitset<32>(value).to_string().substr(32 - bits);
}

// The remainder of text * x^15 by x^15 + x^14 + x^10 + x^8 + x^7 + x^4 + x^3 + 1.
std::string crc15(std::string text) {
  const std::string divisor = "1100010110011001";
  text += std::string(15, '0');
  for (std::size_t i = 0; i + divisor.size() <= text.size(); ++i) {
    if (text[i] == '1') {
      for (std::size_t k = 0; k < divisor.size(); ++k) {
        text[i + k] = text[i + k] == divisor[k] ? '0' : '1';
      }
    }
  }
  return text.substr(text.size() - 15);
}

std::string unstuffed(const can::Frame& frame) {
  std::string text = binary(frame.id, 12) + binary(frame.length, 7);
  for (std::size_t byte = 0; byte < frame.length; ++byte) {
    text += binary(frame.data[byte], 8);
  }
  return text + crc15(text);
}

std::string stuffed(std::string text) {
  for (std::size_t end = 5; end <= text.size(); ++end) {
    const std::string last = text.substr(end - 5, 5);
    if (last == "00000" || last == "11111") {
      text.insert(end, 1, last[0] == '0' ? '1' : '0');
    }
  }
  return text;
}

can::Frame random_frame(Random& random) {
  can::Frame frame;
  frame.id = static_cast<std::uint16_t>(random.below(2048));
  frame.length = static_cast<std::uint8_t>(random.below(9));
  const double runs = random.uniform();
  for (std::size_t byte = 0; byte < frame.length; ++byte) {
    const double kind = random.uniform();
    frame.data[byte] = kind > runs  ? static_cast<std::uint8_t>(random.below(256))
                       : kind < 0.3 ? std::uint8_t{0x0F}
                       : kind < 0.6 ? std::uint8_t{0x87}
                       : kind < 0.8 ? std::uint8_t{0x00}
                                    : std::uint8_t{0x3C};
  }
  return frame;
}

TEST(FrameBits, TheSecondImplementationHasTheKnownCheckValue) {
  std::string text;
  for (const char digit : {'1', '2', '3', '4', '5', '6', '7', '8', '9'}) {
    text += binary(static_cast<unsigned>(digit), 8);
  }
  EXPECT_EQ(crc15(text), binary(0x059E, 15));
}

TEST(FrameBits, AgreesWithTheSecondImplementationAndStaysWithinTheBound) {
  Random random(15, 0, 0);
  std::int64_t least_slack = 1000;
  for (int i = 0; i < 50'000; ++i) {
    const can::Frame frame = random_frame(random);
    const std::int64_t bits = frame_bits(frame);
    ASSERT_EQ(bits, static_cast<std::int64_t>(stuffed(unstuffed(frame)).size()) + 13);
    ASSERT_GE(bits, 47 + 8 * frame.length);
    ASSERT_LE(bits, worst_case_frame_bits(frame.length));
    least_slack = std::min(least_slack, worst_case_frame_bits(frame.length) - bits);
  }
  EXPECT_LE(least_slack, 4);
}

TEST(FrameBits, KnownBounds) {
  EXPECT_EQ(worst_case_frame_bits(0), 55);
  EXPECT_EQ(worst_case_frame_bits(7), 125);
  EXPECT_EQ(worst_case_frame_bits(8), 135);
}

}  // namespace
}  // namespace striker::sil
