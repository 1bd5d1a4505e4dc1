// SPDX-License-Identifier: Apache-2.0
// What waits for transmission: the most urgent first, in the order of the calls within an identifier, never too old.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "firmware/ports/bare_metal/can_driver/transmit_queue.hpp"

namespace striker::bare_metal {

namespace {

can::Frame frame(std::uint16_t id, std::uint8_t mark = 0) {
  return {.id = id, .length = 1, .data = {mark}};
}

std::vector<can::Frame> taken_out(TransmitQueue queue) {
  std::vector<can::Frame> frames;
  for (; !queue.empty(); queue.remove(0)) {
    frames.push_back(queue[0].frame);
  }
  return frames;
}

TEST(TransmitQueue, TheLowestIdentifierFirstAndEachInItsOrder) {
  std::mt19937 random(1);
  for (int round = 0; round < 500; ++round) {
    TransmitQueue queue;
    for (std::uint8_t i = 0; i < TransmitQueue::capacity; ++i) {
      ASSERT_TRUE(queue.add({frame(static_cast<std::uint16_t>(random() % 4), i), 0}));
    }
    const auto frames = taken_out(queue);
    ASSERT_EQ(frames.size(), TransmitQueue::capacity);
    for (std::size_t i = 1; i < frames.size(); ++i) {
      ASSERT_LE(frames[i - 1].id, frames[i].id);
      if (frames[i - 1].id == frames[i].id) {
        ASSERT_LT(frames[i - 1].data[0], frames[i].data[0]);
      }
    }
  }
}

TEST(TransmitQueue, AFullOneTakesWhatIsMoreUrgentInThePlaceOfTheLeastUrgent) {
  TransmitQueue queue;
  for (std::uint8_t i = 0; i < TransmitQueue::capacity; ++i) {
    EXPECT_TRUE(queue.add({frame(5, i), 0}));
  }
  EXPECT_FALSE(queue.add({frame(6), 0}));
  EXPECT_FALSE(queue.add({frame(5, 99), 0}));
  EXPECT_TRUE(queue.add({frame(1), 0}));
  EXPECT_EQ(queue.size(), TransmitQueue::capacity);
  EXPECT_EQ(queue[0].frame, frame(1));
  EXPECT_EQ(queue[TransmitQueue::capacity - 1].frame, frame(5, TransmitQueue::capacity - 2));
}

TEST(TransmitQueue, WhatIsPutBackGoesBeforeTheOthersOfItsIdentifier) {
  TransmitQueue queue;
  EXPECT_TRUE(queue.add({frame(4), 0}));
  EXPECT_TRUE(queue.add({frame(5, 2), 0}));
  EXPECT_TRUE(queue.put_back({frame(5, 1), 0}));
  EXPECT_EQ(taken_out(queue), (std::vector{frame(4), frame(5, 1), frame(5, 2)}));
}

TEST(TransmitQueue, WhatIsTenMillisecondsOldIsDropped) {
  TransmitQueue queue;
  constexpr std::uint32_t wraps = 0xFFFFFFFB;  // 5 ticks before the clock's end
  EXPECT_TRUE(queue.add({frame(2), wraps}));
  EXPECT_TRUE(queue.add({frame(1), wraps + 3}));
  EXPECT_EQ(queue.drop_too_old(wraps + 9), 0U);
  EXPECT_EQ(queue.drop_too_old(wraps + 10), 1U);
  EXPECT_EQ(queue[0].frame, frame(1));
  EXPECT_EQ(queue[0].since_tick, wraps + 3);
  EXPECT_EQ(queue.drop_too_old(wraps + 13), 1U);
  EXPECT_TRUE(queue.empty());
}

}  // namespace

}  // namespace striker::bare_metal
