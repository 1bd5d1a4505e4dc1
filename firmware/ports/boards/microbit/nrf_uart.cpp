// SPDX-License-Identifier: Apache-2.0
// The serial port of Nordic's nRF51 (nRF51 Series Reference Manual 3.0, chapter 28), on the BBC micro:bit's
// pins.
#include <cstdint>

#include "firmware/ports/bare_metal/uart.hpp"

namespace striker::bare_metal::uart {

namespace {

volatile std::uint32_t& at(std::uintptr_t offset) {
  constexpr std::uintptr_t base = 0x40002000;
  return *reinterpret_cast<volatile std::uint32_t*>(base + offset);
}

constexpr std::uintptr_t start_receive = 0x000;
constexpr std::uintptr_t start_transmit = 0x008;
constexpr std::uintptr_t receive_ready = 0x108;
constexpr std::uintptr_t transmit_ready = 0x11C;
constexpr std::uintptr_t enable = 0x500;
constexpr std::uintptr_t transmit_pin = 0x50C;
constexpr std::uintptr_t receive_pin = 0x514;
constexpr std::uintptr_t receive_data = 0x518;
constexpr std::uintptr_t transmit_data = 0x51C;
constexpr std::uintptr_t baud_rate = 0x524;

constexpr std::uint32_t enabled = 4;
constexpr std::uint32_t one_megabaud = 0x10000000;

bool transmitting = false;

}  // namespace

void start() {
  at(transmit_pin) = 24;
  at(receive_pin) = 25;
  at(baud_rate) = one_megabaud;
  at(enable) = enabled;
  at(start_receive) = 1;
  at(start_transmit) = 1;
}

bool try_take(char& letter) {
  if (at(receive_ready) == 0) {
    return false;
  }
  at(receive_ready) = 0;
  letter = static_cast<char>(at(receive_data) & 0xFFU);
  return true;
}

// `transmit_ready` says that the letter before has gone; the first has none before it.
bool try_put(char letter) {
  if (transmitting && at(transmit_ready) == 0) {
    return false;
  }
  transmitting = true;
  at(transmit_ready) = 0;
  at(transmit_data) = static_cast<std::uint8_t>(letter);
  return true;
}

}  // namespace striker::bare_metal::uart
