// SPDX-License-Identifier: Apache-2.0
// The first UART of the Zynq UltraScale+ (AMD UG1087, module UART), as the boot loader left its baud rate.
#include <cstdint>

#include "firmware/ports/bare_metal/uart.hpp"

namespace striker::bare_metal::uart {

namespace {

constexpr std::uintptr_t base = 0xFF000000;
constexpr std::uint32_t enable_receive_and_transmit = 1U << 2U | 1U << 4U;
constexpr std::uint32_t status_receive_empty = 1U << 1U;
constexpr std::uint32_t status_transmit_full = 1U << 4U;

volatile std::uint32_t& control = *reinterpret_cast<volatile std::uint32_t*>(base + 0x00);
volatile std::uint32_t& status = *reinterpret_cast<volatile std::uint32_t*>(base + 0x2C);
volatile std::uint32_t& fifo = *reinterpret_cast<volatile std::uint32_t*>(base + 0x30);

}  // namespace

void start() {
  control = enable_receive_and_transmit;
}

bool try_take(char& letter) {
  if ((status & status_receive_empty) != 0) {
    return false;
  }
  letter = static_cast<char>(fifo & 0xFFU);
  return true;
}

bool try_put(char letter) {
  if ((status & status_transmit_full) != 0) {
    return false;
  }
  fifo = static_cast<std::uint8_t>(letter);
  return true;
}

}  // namespace striker::bare_metal::uart
