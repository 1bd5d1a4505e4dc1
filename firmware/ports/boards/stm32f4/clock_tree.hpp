// SPDX-License-Identifier: Apache-2.0
// From reset's 16 MHz RC oscillator to the system clock that the board wants: crystal, PLL, flash wait states, bus
// prescalers (RM0090, "Reset and clock control" and "Embedded flash memory interface"; limits: STM32F405 data sheet).
//
// Every wait ends. What does not come leaves the RC oscillator running, with which neither a tick nor a bit is what it has
// to be: nothing may go out then. A crystal that stops later raises the NMI (clock security system), which ends in a fault.
#pragma once

#include <cstdint>

#include "firmware/ports/boards/stm32f4/registers.hpp"

namespace striker::stm32f4 {

struct ClockTree {
  std::uint32_t crystal_hz;  // 4 to 26 MHz, a multiple of 1 MHz
  bool crystal_is_clock;     // it comes from outside as a clock, such as another chip's
  std::uint32_t system_hz;   // of the processor and AHB, up to 168 MHz

  // The PLL's input: 2 MHz, which has the least jitter, or 1 MHz.
  [[nodiscard]] constexpr std::uint32_t pll_input_hz() const {
    return crystal_hz % 2'000'000 == 0 ? 2'000'000 : 1'000'000;
  }
  [[nodiscard]] constexpr std::uint32_t divider() const { return crystal_hz / pll_input_hz(); }        // PLLM
  [[nodiscard]] constexpr std::uint32_t multiplier() const { return 2 * system_hz / pll_input_hz(); }  // PLLN
  [[nodiscard]] constexpr std::uint32_t apb1_hz() const { return system_hz / 4; }
  [[nodiscard]] constexpr std::uint32_t apb2_hz() const { return system_hz / 2; }
  // A state for each 30 MHz begun, at 2.7 to 3.6 V.
  [[nodiscard]] constexpr std::uint32_t wait_states() const { return (system_hz - 1) / 30'000'000; }
  [[nodiscard]] constexpr bool is_possible() const {
    return crystal_hz >= 4'000'000 && crystal_hz <= 26'000'000 && crystal_hz % 1'000'000 == 0 &&
           system_hz >= 50'000'000 && system_hz <= 168'000'000 && 2 * system_hz % pll_input_hz() == 0 &&
           multiplier() <= 432;
  }
};

// About 0.1 s on the RC oscillator: ST's HSE_STARTUP_TIMEOUT. A crystal takes 2 ms as a rule.
inline constexpr std::uint32_t most_polls = 100'000;

template <class Registers>
bool comes(Registers& registers, std::uint32_t address, std::uint32_t mask, std::uint32_t value) {
  for (std::uint32_t poll = 0; poll < most_polls; ++poll) {
    if ((registers.read(address) & mask) == value) {
      return true;
    }
  }
  return false;
}

namespace clock_bits {
inline constexpr std::uint32_t rc_on = 1U << 0U;  // of CR
inline constexpr std::uint32_t rc_ready = 1U << 1U;
inline constexpr std::uint32_t crystal_on = 1U << 16U;
inline constexpr std::uint32_t crystal_ready = 1U << 17U;
inline constexpr std::uint32_t crystal_bypass = 1U << 18U;
inline constexpr std::uint32_t security = 1U << 19U;
inline constexpr std::uint32_t pll_on = 1U << 24U;
inline constexpr std::uint32_t pll_ready = 1U << 25U;
inline constexpr std::uint32_t source = 3U << 0U;  // of CFGR: 0 RC, 1 crystal, 2 PLL
inline constexpr std::uint32_t source_is_pll = 2U << 0U;
inline constexpr std::uint32_t source_in_use = 3U << 2U;
inline constexpr std::uint32_t pll_in_use = 2U << 2U;
inline constexpr std::uint32_t prescalers = 0xFCF0;  // of AHB, APB1, APB2
inline constexpr std::uint32_t apb1_by_4 = 5U << 10U;
inline constexpr std::uint32_t apb2_by_2 = 4U << 13U;
inline constexpr std::uint32_t pll_from_crystal = 1U << 22U;  // of PLLCFGR
inline constexpr std::uint32_t pll_reserved = 0xF0000000;     // as reset has them
inline constexpr std::uint32_t pll_q = 7U << 24U;             // USB and SDIO, which nobody uses
inline constexpr std::uint32_t flash_access = 0x40023C00;     // ACR
inline constexpr std::uint32_t flash_latency = 0xFU;
inline constexpr std::uint32_t flash_caches =
    1U << 8U | 1U << 9U | 1U << 10U;  // prefetch, instructions, data
}  // namespace clock_bits

// True once the system clock is the PLL's. A boot loader may have changed any of it before.
template <class Registers>
bool start_clock(Registers& registers, const ClockTree& tree) {
  using namespace clock_bits;
  set_bits(registers, rcc::control, rc_on);
  if (!comes(registers, rcc::control, rc_ready, rc_ready)) {
    return false;
  }
  clear_bits(registers, rcc::configuration, source);
  if (!comes(registers, rcc::configuration, source_in_use, 0)) {
    return false;
  }
  clear_bits(registers, rcc::control, pll_on | security | crystal_on);
  if (!comes(registers, rcc::control, pll_ready | crystal_ready, 0)) {
    return false;
  }
  clear_bits(registers, rcc::control, crystal_bypass);
  set_bits(registers, rcc::control, tree.crystal_is_clock ? crystal_bypass : 0);
  set_bits(registers, rcc::control, crystal_on);
  if (!comes(registers, rcc::control, crystal_ready, crystal_ready)) {
    return false;
  }
  registers.write(rcc::pll, (registers.read(rcc::pll) & pll_reserved) | pll_q | pll_from_crystal |
                                tree.multiplier() << 6U | tree.divider());
  set_bits(registers, rcc::control, pll_on);
  if (!comes(registers, rcc::control, pll_ready, pll_ready)) {
    return false;
  }
  registers.write(flash_access, flash_caches | tree.wait_states());
  if (!comes(registers, flash_access, flash_latency, tree.wait_states())) {
    return false;
  }
  clear_bits(registers, rcc::configuration, prescalers);
  set_bits(registers, rcc::configuration, apb1_by_4 | apb2_by_2);
  set_bits(registers, rcc::configuration, source_is_pll);
  if (!comes(registers, rcc::configuration, source_in_use, pll_in_use)) {
    return false;
  }
  set_bits(registers, rcc::control, security);
  return true;
}

}  // namespace striker::stm32f4
