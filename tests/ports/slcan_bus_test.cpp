// SPDX-License-Identifier: Apache-2.0
// CAN over a serial port that is a test's: what was put comes out as frames, and a transmitter that stops stops
// nobody else.
#include <gtest/gtest.h>

#include <deque>
#include <limits>
#include <string>
#include <vector>

#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/clock.hpp"
#include "firmware/ports/bare_metal/slcan.hpp"
#include "firmware/ports/bare_metal/uart.hpp"

namespace striker::bare_metal {

namespace {

constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

struct Port {
  std::deque<char> to_take;
  std::string put;
  std::size_t room = no_limit;  // letters until the transmitter stops
  std::uint32_t asked = 0;      // how often for the time: ten times a tick
} port;

constexpr can::Frame frame = {.id = 0x123, .length = 2, .data = {0xAB, 0x01}};

// The frames that somebody at the other end of the line reads.
std::vector<can::Frame> read_by_the_other_end() {
  SlcanReader reader;
  std::vector<can::Frame> frames;
  can::Frame read;
  for (const char letter : port.put) {
    if (reader.take(letter, read)) {
      frames.push_back(read);
    }
  }
  return frames;
}

}  // namespace

std::uint32_t ticks() {
  return port.asked++ / 10;
}

namespace uart {

void start() {
  port = {};
}

bool try_take(char& letter) {
  if (port.to_take.empty()) {
    return false;
  }
  letter = port.to_take.front();
  port.to_take.pop_front();
  return true;
}

bool try_put(char letter) {
  if (port.room == 0) {
    return false;
  }
  port.room -= port.room == no_limit ? 0 : 1;
  port.put += letter;
  return true;
}

}  // namespace uart

namespace {

TEST(SlcanBus, SendsAndReceivesFramesOneByOne) {
  start_can();
  EXPECT_TRUE(try_send_can(frame));
  EXPECT_EQ(port.put, "t1232AB01\r");
  port.to_take.assign(port.put.begin(), port.put.end());
  port.to_take.insert(port.to_take.end(), port.put.begin(), port.put.end() - 1);
  can::Frame received;
  EXPECT_TRUE(receive_can(received));
  EXPECT_EQ(received, frame);
  EXPECT_FALSE(receive_can(received)) << "the second has not ended";
  port.to_take.push_back('\r');
  EXPECT_TRUE(receive_can(received));
  EXPECT_EQ(can_health(), can::BusHealth::active);
}

TEST(SlcanBus, AStoppedTransmitterTakesNoLongerThanTwoTicks) {
  for (const std::size_t room : {0U, 1U, 4U, 9U}) {
    start_can();
    port.room = room;
    EXPECT_FALSE(try_send_can(frame));
    EXPECT_LE(ticks(), 3U) << "two, and one for asking";
    EXPECT_EQ(port.put.size(), room);
    const std::uint32_t before = ticks();
    EXPECT_FALSE(try_send_can(frame)) << "still stopped";
    EXPECT_LE(ticks() - before, 3U);
    port.room = no_limit;
    EXPECT_TRUE(try_send_can(frame));
    EXPECT_TRUE(try_send_can(frame));
    EXPECT_EQ(read_by_the_other_end(), std::vector(2, frame))
        << "the broken line is no frame, " << room << " letters";
  }
}

}  // namespace

}  // namespace striker::bare_metal
