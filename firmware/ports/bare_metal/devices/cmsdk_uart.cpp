// SPDX-License-Identifier: Apache-2.0
// The serial port of Arm's MPS2 and MPS3 boards (CMSDK APB UART: Arm DDI 0479, 4.3); STRIKER_UART says where.
#include <cstdint>

#include "firmware/ports/bare_metal/uart.hpp"

namespace striker::bare_metal::uart {

namespace {

struct Registers {
  std::uint32_t data;
  std::uint32_t state;
  std::uint32_t control;
  std::uint32_t interrupt;
  std::uint32_t divider;
};

constexpr std::uint32_t state_transmit_full = 1U << 0U;
constexpr std::uint32_t state_receive_full = 1U << 1U;
constexpr std::uint32_t control_transmit_and_receive = 3U;
constexpr std::uint32_t least_divider = 16;  // 25 MHz / 16: 1.56 Mbaud

volatile Registers& registers() {
  return *reinterpret_cast<volatile Registers*>(STRIKER_UART);
}

}  // namespace

void start() {
  registers().divider = least_divider;
  registers().control = control_transmit_and_receive;
}

bool try_take(char& letter) {
  if ((registers().state & state_receive_full) == 0) {
    return false;
  }
  letter = static_cast<char>(registers().data & 0xFFU);
  return true;
}

bool try_put(char letter) {
  if ((registers().state & state_transmit_full) != 0) {
    return false;
  }
  registers().data = static_cast<std::uint8_t>(letter);
  return true;
}

}  // namespace striker::bare_metal::uart
