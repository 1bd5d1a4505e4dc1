// SPDX-License-Identifier: Apache-2.0
// CAN over a serial port. No bus is behind it that could be off, and no flow control that could stop it: the
// transmitter empties itself, so a frame waits for its own letters alone, 220 us at 1 Mbaud. That wait is
// bounded: a transmitter that takes nothing for a whole tick is broken, and the rest of the line is dropped.
// A ring would save the wait, but cost RAM that an image for a real bus does not need.
#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/clock.hpp"
#include "firmware/ports/bare_metal/slcan.hpp"
#include "firmware/ports/bare_metal/uart.hpp"

namespace striker::bare_metal {

namespace {

SlcanReader reader;
bool line_is_open = false;  // the last line was broken off

// False after a tick, from its beginning to its end, without room. Apart, as how often it waits is assumed where the whole
// tick is bounded (tools/step_bound/facts.toml).
[[gnu::noinline]] bool put_in_time(char letter) {
  const std::uint32_t begin = ticks();
  while (!uart::try_put(letter)) {
    if (ticks() - begin > 1) {
      return false;
    }
  }
  return true;
}

}  // namespace

void start_can() {
  uart::start();
}

bool receive_can(can::Frame& frame) {
  char letter = 0;
  while (uart::try_take(letter)) {
    if (reader.take(letter, frame)) {
      return true;
    }
  }
  return false;
}

bool try_send_can(const can::Frame& frame) {
  // The letter belongs to no frame: a line that lacked its end alone must not become one now.
  if (line_is_open && !(put_in_time('-') && put_in_time('\r'))) {
    return false;
  }
  const SlcanLine line = slcan_line(frame);
  for (std::size_t i = 0; i < line.length; ++i) {
    line_is_open = true;
    if (!put_in_time(line.text[i])) {
      return false;
    }
  }
  line_is_open = false;
  return true;
}

can::BusHealth can_health() {
  return can::BusHealth::active;
}

}  // namespace striker::bare_metal
