// SPDX-License-Identifier: Apache-2.0
// CAN1 on PB8 (receive) and PB9 (transmit), with its reception interrupt. It has not run on silicon: see README.md.
#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/can_driver/accepted_identifiers.hpp"
#include "firmware/ports/bare_metal/clock.hpp"
#include "firmware/ports/boards/stm32f4/bit_timing.hpp"
#include "firmware/ports/boards/stm32f4/board_clock_tree.hpp"
#include "firmware/ports/boards/stm32f4/bxcan.hpp"

extern "C" void can1_reception();

namespace striker::bare_metal {

namespace {

using namespace stm32f4;

constexpr std::uint32_t bit_rate = 1'000'000;
constexpr BitTiming timing = bit_timing(clock_tree.apb1_hz(), bit_rate);
static_assert(timing.prescaler != 0 && timing.bit_rate(clock_tree.apb1_hz()) == bit_rate,
              "STRIKER BOARD: a quarter of CLOCK_HZ makes no 1 Mbit/s with its sample point near 75 %");

constexpr std::uint32_t pin_function = 9;
constexpr std::uint32_t enable_interrupts = 0xE000E100;  // NVIC_ISER0

constinit BxCan<Memory> driver;

}  // namespace

// The block's reset drops what it held from before.
void start_can() {
  start_board_clock();
  Memory memory;
  set_bits(memory, rcc::enable_ahb1, rcc::port_b);
  set_bits(memory, rcc::enable_apb1, rcc::can1);
  set_bits(memory, rcc::reset_apb1, rcc::can1);
  clear_bits(memory, rcc::reset_apb1, rcc::can1);
  give_pin_to(memory, gpio::port_b, 8, pin_function);
  give_pin_to(memory, gpio::port_b, 9, pin_function);
  driver.start(timing.register_value(), accepted_identifiers);
  Memory::write(enable_interrupts, 1U << can1::reception_line);
}

bool receive_can(can::Frame& frame) {
  return driver.receive(frame, ticks());
}

bool try_send_can(const can::Frame& frame) {
  return driver.try_send(frame, ticks());
}

can::BusHealth can_health() {
  return driver.health(ticks());
}

}  // namespace striker::bare_metal

void can1_reception() {
  striker::bare_metal::driver.on_reception();
}
