// SPDX-License-Identifier: Apache-2.0
// A driver that is none of the tree's: it sends each frame as a line "own RECEIVED FRAME", and its interrupt receives.
#include <array>
#include <cstdint>

#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/clock.hpp"
#include "firmware/ports/bare_metal/slcan.hpp"

namespace own_can {

volatile std::uint32_t frames_received = 0;

namespace {

using striker::bare_metal::SlcanReader;
using striker::can::Frame;

// The serial port (CMSDK APB UART: Arm DDI 0479, 4.3), and the enabling of its interrupt.
struct Port {
  std::uint32_t data;
  std::uint32_t state;
  std::uint32_t control;
  std::uint32_t interrupt;
  std::uint32_t divider;
};
volatile Port& port = *reinterpret_cast<volatile Port*>(OWN_PORT);
volatile std::uint32_t& enable_interrupts = *reinterpret_cast<volatile std::uint32_t*>(0xE000E100);

constexpr std::uint32_t transmit_full = 1U << 0U;
constexpr std::uint32_t receive_full = 1U << 1U;
constexpr std::uint32_t both_and_receive_interrupt = 1U << 0U | 1U << 1U | 1U << 3U;

constexpr std::uint32_t room = 32;
SlcanReader reader;
std::array<Frame, room> frames;
std::uint32_t taken = 0;

bool put(char letter) {
  const std::uint32_t begin = striker::bare_metal::ticks();
  while ((port.state & transmit_full) != 0) {
    if (striker::bare_metal::ticks() - begin > 1) {
      return false;
    }
  }
  port.data = static_cast<std::uint8_t>(letter);
  return true;
}

}  // namespace

}  // namespace own_can

extern "C" void own_letter_received() {
  using namespace own_can;
  // Before the letters are read: one that comes after them asks again.
  port.interrupt = 1U << 1U;
  while ((port.state & receive_full) != 0) {
    Frame frame;
    if (reader.take(static_cast<char>(port.data & 0xFFU), frame) && frames_received - taken < room) {
      frames[frames_received % room] = frame;
      frames_received = frames_received + 1;
    }
  }
}

namespace striker::bare_metal {

void start_can() {
  own_can::port.divider = 16;
  own_can::port.control = own_can::both_and_receive_interrupt;
  own_can::enable_interrupts = 1U << 0U;
}

bool receive_can(can::Frame& frame) {
  using namespace own_can;
  if (taken == frames_received) {
    return false;
  }
  frame = frames[taken % room];
  taken = taken + 1;
  return true;
}

bool try_send_can(const can::Frame& frame) {
  const char received = static_cast<char>('0' + own_can::frames_received % 10);
  for (const char letter : {'o', 'w', 'n', ' ', received, ' '}) {
    if (!own_can::put(letter)) {
      return false;
    }
  }
  const SlcanLine line = slcan_line(frame);
  for (std::size_t i = 0; i < line.length; ++i) {
    if (!own_can::put(line.text[i])) {
      return false;
    }
  }
  return true;
}

can::BusHealth can_health() {
  return can::BusHealth::active;
}

}  // namespace striker::bare_metal
