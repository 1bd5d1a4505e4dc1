// SPDX-License-Identifier: Apache-2.0
// A counter that comes again: the same frame is a repetition, which costs one step of belief; another frame, in whatever bit, is
// of a second sender, and nothing is believed.
#include <gtest/gtest.h>

#include <cstdint>

#include "firmware/can/message_receiver.hpp"

namespace striker::can {
namespace {

constexpr FrameSequence::Rules rules = {.window = fast_window, .timeout_ticks = 25};
constexpr std::size_t counter_byte = 1;

class RepeatedCounter : public testing::Test {
 protected:
  FrameSequence sequence;
  std::uint32_t tick = 1000;
  Frame frame = {.id = 0x123, .length = 8, .data = {0x11, 0x20, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88}};

  // Whether the frame is taken, as one whose CRC is correct.
  bool takes(const Frame& sound) {
    return sequence.take(rules, sound, ++tick, Verdict::accepted) == Verdict::accepted;
  }
  bool takes_next() {
    frame.data[counter_byte] = static_cast<std::uint8_t>((frame.data[counter_byte] & 0xF0U) |
                                                         ((frame.data[counter_byte] + 1U) & 0x0FU));
    return takes(frame);
  }
  void believe() {
    for (int i = 0; i < 20; ++i) {
      static_cast<void>(takes_next());
    }
    ASSERT_TRUE(takes_next());
  }
};

TEST_F(RepeatedCounter, TheSameFrameAgainIsNotTakenAndCostsNoBelief) {
  believe();
  EXPECT_FALSE(takes(frame));
  EXPECT_TRUE(takes_next());
}

TEST_F(RepeatedCounter, AnyOtherBitUnderTheSameCounterEndsBelief) {
  for (std::size_t bit = 0; bit < 64; ++bit) {
    if (bit / 8 == counter_byte && bit % 8 < 4) {
      continue;  // the counter itself
    }
    SCOPED_TRACE(bit);
    believe();
    Frame other = frame;
    other.data[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_FALSE(takes(other));
    EXPECT_FALSE(takes_next());
  }
}

TEST_F(RepeatedCounter, AnotherMessageUnderTheSameCounterEndsBelief) {
  believe();
  Frame other = frame;
  ++other.id;
  EXPECT_FALSE(takes(other));
  EXPECT_FALSE(takes_next());
}

}  // namespace
}  // namespace striker::can
