// SPDX-License-Identifier: Apache-2.0
// USART1 (RM0090, "Universal synchronous asynchronous receiver transmitter") on PA9 (transmit) and PA10, at 1 Mbaud. It has
// no receive FIFO: on silicon a letter that comes while a step runs is lost.
#include "firmware/ports/bare_metal/uart.hpp"

#include "firmware/ports/boards/stm32f4/board_clock_tree.hpp"

namespace striker::bare_metal::uart {

namespace {

using namespace stm32f4;

constexpr std::uint32_t base = 0x40011000;
constexpr std::uint32_t status = base + 0x00;
constexpr std::uint32_t data = base + 0x04;
constexpr std::uint32_t baud_rate = base + 0x08;
constexpr std::uint32_t control = base + 0x0C;

constexpr std::uint32_t received = 1U << 5U;
constexpr std::uint32_t transmit_empty = 1U << 7U;
constexpr std::uint32_t enable = 1U << 13U | 1U << 3U | 1U << 2U;  // with transmitter and receiver
constexpr std::uint32_t pin_function = 7;

static_assert(clock_tree.apb2_hz() % 1'000'000 == 0, "1 Mbaud is no whole divider of APB2");

}  // namespace

void start() {
  start_board_clock();
  Memory memory;
  set_bits(memory, rcc::enable_ahb1, rcc::port_a);
  set_bits(memory, rcc::enable_apb2, rcc::usart1);
  give_pin_to(memory, gpio::port_a, 9, pin_function);
  give_pin_to(memory, gpio::port_a, 10, pin_function);
  Memory::write(baud_rate, clock_tree.apb2_hz() / 1'000'000);  // in sixteenths, of 16 samples a bit
  Memory::write(control, enable);
}

bool try_take(char& letter) {
  if ((Memory::read(status) & received) == 0) {
    return false;
  }
  letter = static_cast<char>(Memory::read(data) & 0xFFU);
  return true;
}

bool try_put(char letter) {
  if ((Memory::read(status) & transmit_empty) == 0) {
    return false;
  }
  Memory::write(data, static_cast<std::uint8_t>(letter));
  return true;
}

}  // namespace striker::bare_metal::uart
