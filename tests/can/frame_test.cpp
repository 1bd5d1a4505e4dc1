// SPDX-License-Identifier: Apache-2.0
#include "firmware/can/frame.hpp"

#include <gtest/gtest.h>

#include "firmware/can/frame_list.hpp"
#include "firmware/can/layout.hpp"

namespace striker::can {
namespace {

constexpr Frame some_frame = {.id = 5, .length = 2, .data = {1, 2}};

TEST(Frame, EqualIsWhatIsEqualOnTheWire) {
  Frame other = some_frame;
  other.age_ms = 9;
  EXPECT_EQ(other, some_frame);
  other.id = 6;
  EXPECT_FALSE(other == some_frame);
  other = some_frame;
  other.length = 1;
  EXPECT_FALSE(other == some_frame);
  other = some_frame;
  other.data[7] = 1;
  EXPECT_FALSE(other == some_frame);
}

TEST(FrameList, TakesNoMoreThanItsCapacity) {
  FrameList list;
  for (std::size_t i = 0; i < FrameList::capacity + 3; ++i) {
    list.add({.id = static_cast<std::uint16_t>(i), .data = {}});
  }
  ASSERT_EQ(list.frames().size(), FrameList::capacity);
  EXPECT_EQ(list.frames().back().id, FrameList::capacity - 1);
  EXPECT_EQ(list.keep([](const Frame& frame) { return frame.id % 2 == 0; }), FrameList::capacity / 2);
  EXPECT_EQ(list.frames()[1].id, 2);
}

TEST(Layout, AMaskMayBeAWholeWord) {
  EXPECT_EQ(detail::bit_mask(12), 0xFFFU);
  EXPECT_EQ(detail::bit_mask(64), ~std::uint64_t{0});
}

}  // namespace
}  // namespace striker::can
