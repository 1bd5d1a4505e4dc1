// SPDX-License-Identifier: Apache-2.0
#include "sil/bus/arbitrated_bus.hpp"

#include <gtest/gtest.h>

#include "sil/bus/frame_bits.hpp"

namespace striker::sil {
namespace {

constexpr std::int64_t bit_ns = 1000;

QueuedFrame frame(std::uint16_t id, std::int64_t queued_ns, std::int64_t bits = 100) {
  return {{id, 0, {}}, bits, queued_ns};
}

std::vector<std::uint16_t> order(ArbitratedBus& bus) {
  std::vector<std::uint16_t> ids;
  while (const auto sent = bus.next(100'000'000)) {
    ids.push_back(sent->queued.frame.id);
  }
  return ids;
}

TEST(ArbitratedBus, TheLowestIdentifierWins) {
  ArbitratedBus bus(bit_ns);
  for (const int id : {0x7FF, 0x400, 0x3FF, 0x055, 0x054, 0x2AA}) {
    bus.queue(frame(static_cast<std::uint16_t>(id), 0));
  }
  EXPECT_EQ(order(bus), (std::vector<std::uint16_t>{0x054, 0x055, 0x2AA, 0x3FF, 0x400, 0x7FF}));
}

TEST(ArbitratedBus, AFrameThatHasBegunIsNotInterrupted) {
  ArbitratedBus bus(bit_ns);
  bus.queue(frame(0x700, 0));
  bus.queue(frame(0x100, bit_ns));  // a bit later
  EXPECT_EQ(order(bus), (std::vector<std::uint16_t>{0x700, 0x100}));
}

TEST(ArbitratedBus, WithinTheFirstBitAFrameStillJoins) {
  ArbitratedBus bus(bit_ns);
  bus.queue(frame(0x700, 0));
  bus.queue(frame(0x100, bit_ns - 1));
  EXPECT_EQ(order(bus), (std::vector<std::uint16_t>{0x100, 0x700}));
}

TEST(ArbitratedBus, TimesOfAFrame) {
  ArbitratedBus bus(bit_ns);
  bus.queue(frame(0x100, 12'345));
  bus.queue(frame(0x200, 20'000));
  EXPECT_FALSE(bus.next(12'345 + 97'000 - 1));
  const auto first = bus.next(12'345 + 97'000);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->start_ns, 12'345);
  EXPECT_EQ(first->received_ns, 12'345 + 97'000);
  EXPECT_EQ(first->free_ns, 12'345 + 100'000);
  const auto second = bus.next(1'000'000);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->start_ns, first->free_ns);
  EXPECT_EQ(bus.busy_ns(), 200'000);
}

// A caller that learns of a frame answers it: the answer takes part in the next arbitration.
TEST(ArbitratedBus, AnAnswerToAFrameMeetsTheNextArbitration) {
  ArbitratedBus bus(bit_ns);
  bus.queue(frame(0x030, 0));
  bus.queue(frame(0x060, 0));
  const auto sync = bus.next(1'000'000);
  ASSERT_TRUE(sync);
  bus.queue(frame(0x050, sync->received_ns));
  EXPECT_EQ(order(bus), (std::vector<std::uint16_t>{0x050, 0x060}));
}

TEST(ArbitratedBus, ADestroyedFrameIsSentAgainAndArbitratesAnew) {
  ArbitratedBus bus(bit_ns, {{50'500, 31}});
  bus.queue(frame(0x200, 0));
  bus.queue(frame(0x100, 10'000));
  const auto first = bus.next(1'000'000);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->queued.frame.id, 0x100);
  EXPECT_EQ(first->start_ns, 51'000 + 31'000);
  EXPECT_EQ(order(bus), std::vector<std::uint16_t>{0x200});
}

TEST(ArbitratedBus, AnErrorOnAnIdleBusChangesNothing) {
  ArbitratedBus bus(bit_ns, {{10, 31}, {99'500, 31}});  // the second in the intermission
  bus.queue(frame(0x200, 1000));
  const auto sent = bus.next(1'000'000);
  ASSERT_TRUE(sent);
  EXPECT_EQ(sent->start_ns, 1000);
  EXPECT_EQ(sent->free_ns, 101'000);
}

TEST(ArbitratedBus, TheLastWaitingFrameCanBeTakenBack) {
  ArbitratedBus bus(bit_ns);
  EXPECT_FALSE(bus.withdraw(0x100));
  bus.queue(frame(0x100, 0));
  bus.queue(frame(0x100, 500));
  EXPECT_TRUE(bus.withdraw(0x100));
  EXPECT_EQ(order(bus), std::vector<std::uint16_t>{0x100});
  EXPECT_FALSE(bus.withdraw(0x100));
}

}  // namespace
}  // namespace striker::sil
