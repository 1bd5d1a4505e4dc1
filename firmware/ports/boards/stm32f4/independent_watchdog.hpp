// SPDX-License-Identifier: Apache-2.0
// The independent watchdog (RM0090, "Independent watchdog"): on an RC oscillator of its own, which it starts, and not to be
// stopped. It resets at once; the reset's cause tells. The oscillator has 17 to 47 kHz, 32 as a rule (STM32F405 data sheet).
#pragma once

#include <cstdint>

#include "firmware/ports/boards/stm32f4/registers.hpp"

namespace striker::stm32f4::iwdg {

inline constexpr std::uint32_t base = 0x40003000;
inline constexpr std::uint32_t key = base + 0x00;        // KR
inline constexpr std::uint32_t prescaler = base + 0x04;  // PR
inline constexpr std::uint32_t reload = base + 0x08;     // RLR, 12 bits
inline constexpr std::uint32_t status = base + 0x0C;     // SR: an update of the two has not arrived

inline constexpr std::uint32_t key_start = 0xCCCC;
inline constexpr std::uint32_t key_unlock = 0x5555;
inline constexpr std::uint32_t key_feed = 0xAAAA;

inline constexpr std::uint32_t clocks_a_count = 4;  // what a prescaler of 0 means
inline constexpr std::uint32_t oscillator_hz = 32'000;
inline constexpr std::uint32_t most_polls =
    100'000;  // an update takes five of the oscillator's periods, 0.3 ms

// An update that does not come leaves the longest time-out, 0.5 s: the watchdog bites late, but it does.
template <class Registers>
void start(Registers& registers, std::uint32_t timeout_ms) {
  set_bits(registers, rcc::control_status, rcc::remove_reset_flags);
  registers.write(key, key_start);
  registers.write(key, key_unlock);
  registers.write(prescaler, 0);
  registers.write(reload, oscillator_hz / clocks_a_count * timeout_ms / 1000 - 1);
  for (std::uint32_t poll = 0; poll < most_polls && registers.read(status) != 0; ++poll) {
  }
  registers.write(key, key_feed);
}

}  // namespace striker::stm32f4::iwdg
