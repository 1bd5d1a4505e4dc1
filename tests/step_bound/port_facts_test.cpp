// SPDX-License-Identifier: Apache-2.0
// What tools/step_bound/facts.toml says of a board's port, on a board that is played: its clock goes on with every poll, by a
// microsecond or by a pause of up to seconds, and frames come as they like.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

#include "firmware/loop/clock_ticks.hpp"
#include "firmware/ports/bare_metal/board_bus.hpp"
#include "firmware/ports/bare_metal/board_clock.hpp"
#include "firmware/ports/bare_metal/can_driver/transmit_queue.hpp"
#include "firmware/ports/bare_metal/slcan.hpp"

namespace striker::bare_metal {

namespace {

std::mt19937 generator(1);
std::uint64_t now_us = 0;
std::uint32_t arrived = 0;

std::uint32_t below(std::uint32_t limit) {
  return std::uniform_int_distribution<std::uint32_t>(0, limit - 1)(generator);
}

void let_time_pass() {
  now_us += below(100) != 0 ? 1 + below(60) : below(50) != 0 ? below(5'000) : below(3'000'000);
}

}  // namespace

std::uint32_t ticks() {
  return static_cast<std::uint32_t>(now_us / 1'000);
}
std::uint32_t since_tick_us() {
  return static_cast<std::uint32_t>(now_us % 1'000);
}
bool receive_can(can::Frame& frame) {
  let_time_pass();
  arrived += below(8) == 0 ? below(6) : 0;
  if (arrived == 0) {
    return false;
  }
  --arrived;
  frame = {};
  return true;
}
bool try_send_can(const can::Frame&) {
  return true;
}
can::BusHealth can_health() {
  return can::BusHealth::active;
}

namespace {

using Ticks = loop::ClockTicks<BoardClock>;
constexpr int played_ticks = 20'000;

// A frame's reception is later than the one's before it by more than the ticks between two polls only where an age falls: so a
// sequence sees a silence before its first frame of a tick, and once more at most.
TEST(PortFacts, WithinATickNoAgeFallsTwice) {
  BoardClock clock;
  BoardBus bus(clock);
  Ticks source(clock, {.frames_per_tick = most_frames_a_tick, .overrun_limit = 50});
  int fell = 0;
  for (int i = 0; i < played_ticks; ++i) {
    const auto tick = source.next(bus);
    int falls = 0;
    for (std::size_t at = 1; at < tick->frames.size(); ++at) {
      falls += tick->frames[at].age_ms < tick->frames[at - 1].age_ms ? 1 : 0;
    }
    ASSERT_LE(falls, 1);
    ASSERT_LE(tick->frames.size(), most_frames_a_tick);
    fell += falls;
    now_us += below(10) == 0 ? below(4'000) : below(600);  // the step
  }
  EXPECT_GT(fell, 100);
}

TEST(PortFacts, AClockNeverBeginsAnew) {
  BoardClock clock;
  BoardBus bus(clock);
  Ticks source(clock, {.frames_per_tick = most_frames_a_tick, .overrun_limit = 50});
  std::uint32_t before = ticks();
  for (int i = 0; i < played_ticks; ++i) {
    const auto tick = source.next(bus);
    ASSERT_FALSE(tick->restart);
    ASSERT_LT(tick->number - before, 0x80000000U);
    before = tick->number;
  }
}

// Whatever is put in and taken out: loops over the queue turn as often at most, and 15 times where one leaves it.
TEST(PortFacts, SixteenFramesWait) {
  static_assert(TransmitQueue::capacity == 16);
  TransmitQueue queue;
  for (int i = 0; i < 10'000; ++i) {
    const Waiting waiting = {.frame = {.id = static_cast<std::uint16_t>(below(2'048)), .data = {}},
                             .since_tick = static_cast<std::uint32_t>(i)};
    if (below(4) != 0) {
      (void)(below(2) == 0 ? queue.add(waiting) : queue.put_back(waiting));
    } else if (!queue.empty()) {
      queue.remove(below(static_cast<std::uint32_t>(queue.size())));
    }
    ASSERT_LE(queue.size(), 16U);
  }
}

TEST(PortFacts, AFrameIs22Letters) {
  for (std::uint8_t length = 0; length <= 8; ++length) {
    EXPECT_LE(slcan_line({.id = 0x7FF, .length = length, .data = {}}).length, 22U);
  }
}

// How many lines end among so many letters at most that are long enough to be looked at, whichever letters end one: by how long the line is so far.
unsigned most_lines(unsigned letters) {
  constexpr auto shortest = static_cast<unsigned>(SlcanReader::shortest);
  std::array<unsigned, shortest + 1>
      most{};  // by the line's length before; the longest stands for all that are as long
  for (unsigned left = 0; left < letters; ++left) {
    std::array<unsigned, shortest + 1> before{};
    for (unsigned length = 0; length <= shortest; ++length) {
      const unsigned if_it_ends = most[0] + (length == shortest ? 1U : 0U);
      before[length] = std::max(if_it_ends, most[std::min(length + 1, shortest)]);
    }
    most = before;
  }
  return *std::max_element(most.begin(), most.end());
}

// Any letters, after any that came before.
TEST(PortFacts, LettersEndSoManyLines) {
  EXPECT_EQ(most_lines(8), 2U);
  EXPECT_EQ(most_lines(24), 4U);
}

// On a board, whose sizes have 32 bits, and without the padding behind its last member.
TEST(PortFacts, AMeasurementHas29Bytes) {
  using Measurement = loop::TickMeasurement<BoardClock::Time>;
  constexpr std::size_t wider = sizeof(Measurement::received) - sizeof(std::uint32_t);
  EXPECT_EQ(offsetof(Measurement, full) + sizeof(bool) - wider, 29U);
}

}  // namespace
}  // namespace striker::bare_metal
