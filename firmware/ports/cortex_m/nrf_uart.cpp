// The serial port of Nordic's nRF51 (nRF51 Series Reference Manual 3.0, chapter 28), on the BBC micro:bit's
// pins.
#include <cstdint>

#include "firmware/ports/bare_metal/uart.hpp"

namespace striker::bare_metal::uart {

namespace {

volatile std::uint32_t& at(std::uintptr_t offset) {
  return *reinterpret_cast<volatile std::uint32_t*>(STRIKER_UART + offset);
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

}  // namespace

void start() {
  at(transmit_pin) = 24;
  at(receive_pin) = 25;
  at(baud_rate) = one_megabaud;
  at(enable) = enabled;
  at(start_receive) = 1;
  at(start_transmit) = 1;
}

bool has_letter() {
  return at(receive_ready) != 0;
}

char take_letter() {
  at(receive_ready) = 0;
  return static_cast<char>(at(receive_data) & 0xFFU);
}

void put_letter(char letter) {
  at(transmit_ready) = 0;
  at(transmit_data) = static_cast<std::uint8_t>(letter);
  while (at(transmit_ready) == 0) {
  }
}

}  // namespace striker::bare_metal::uart
