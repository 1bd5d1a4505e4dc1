// SPDX-License-Identifier: Apache-2.0
// The STM32F4's registers, by address, as RM0090 (F405) and RM0390 (F446) have them in common. What needs more than one
// write in a row takes its access to them as an argument, so that tests on a host put a model in the place of memory.hpp.
#pragma once

#include <cstdint>

namespace striker::stm32f4 {

template <class Registers>
void set_bits(Registers& registers, std::uint32_t address, std::uint32_t bits) {
  registers.write(address, registers.read(address) | bits);
}

template <class Registers>
void clear_bits(Registers& registers, std::uint32_t address, std::uint32_t bits) {
  registers.write(address, registers.read(address) & ~bits);
}

namespace rcc {  // reset and clock control
inline constexpr std::uint32_t base = 0x40023800;
inline constexpr std::uint32_t control = base + 0x00;         // CR
inline constexpr std::uint32_t pll = base + 0x04;             // PLLCFGR
inline constexpr std::uint32_t configuration = base + 0x08;   // CFGR
inline constexpr std::uint32_t reset_apb1 = base + 0x20;      // APB1RSTR
inline constexpr std::uint32_t enable_ahb1 = base + 0x30;     // AHB1ENR
inline constexpr std::uint32_t enable_apb1 = base + 0x40;     // APB1ENR
inline constexpr std::uint32_t enable_apb2 = base + 0x44;     // APB2ENR
inline constexpr std::uint32_t control_status = base + 0x74;  // CSR
inline constexpr std::uint32_t port_a = 1U << 0U;             // of AHB1
inline constexpr std::uint32_t port_b = 1U << 1U;
inline constexpr std::uint32_t can1 = 1U << 25U;                // of APB1
inline constexpr std::uint32_t usart1 = 1U << 4U;               // of APB2
inline constexpr std::uint32_t remove_reset_flags = 1U << 24U;  // of CSR
inline constexpr std::uint32_t reset_by_watchdog = 1U << 29U;   // of CSR: the independent one
}  // namespace rcc

namespace gpio {
inline constexpr std::uint32_t port_a = 0x40020000;
inline constexpr std::uint32_t port_b = 0x40020400;
}  // namespace gpio

// A pin of a port that a peripheral drives, with a pull-up, at the second speed of four.
template <class Registers>
void give_pin_to(Registers& registers, std::uint32_t port, std::uint32_t pin, std::uint32_t function) {
  constexpr std::uint32_t mode = 0x00;
  constexpr std::uint32_t speed = 0x08;
  constexpr std::uint32_t pull = 0x0C;
  const std::uint32_t alternate = pin < 8 ? 0x20 : 0x24;
  const auto change = [&](std::uint32_t offset, std::uint32_t bits, std::uint32_t at, std::uint32_t value) {
    const std::uint32_t mask = ((1U << bits) - 1U) << (bits * at);
    registers.write(port + offset, (registers.read(port + offset) & ~mask) | value << (bits * at));
  };
  change(alternate, 4, pin % 8, function);
  change(speed, 2, pin, 1);
  change(pull, 2, pin, 1);
  change(mode, 2, pin, 2);
}

}  // namespace striker::stm32f4
