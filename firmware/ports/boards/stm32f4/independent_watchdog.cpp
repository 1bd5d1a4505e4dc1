// SPDX-License-Identifier: Apache-2.0
// The independent watchdog (RM0090, "Independent watchdog"): on an RC oscillator of its own, which it starts, and not to be
// stopped. It resets at once; the reset's cause tells. The oscillator has 17 to 47 kHz, 32 as a rule (STM32F405 data sheet):
// 20 ms are 14 to 38, within what watchdog.hpp allows. QEMU has none.
#include "firmware/ports/bare_metal/watchdog.hpp"

#include "firmware/ports/boards/stm32f4/memory.hpp"
#include "firmware/ports/boards/stm32f4/registers.hpp"

namespace striker::bare_metal {

namespace {

using namespace stm32f4;

constexpr std::uint32_t base = 0x40003000;
constexpr std::uint32_t key = base + 0x00;
constexpr std::uint32_t prescaler = base + 0x04;
constexpr std::uint32_t reload = base + 0x08;
constexpr std::uint32_t status = base + 0x0C;

constexpr std::uint32_t key_start = 0xCCCC;
constexpr std::uint32_t key_unlock = 0x5555;
constexpr std::uint32_t key_feed = 0xAAAA;
constexpr std::uint32_t prescaler_by_4 = 0;
constexpr std::uint32_t oscillator_hz = 32'000;
constexpr std::uint32_t counts = oscillator_hz / 4 * watchdog_timeout_ms / 1000;
constexpr std::uint32_t most_polls = 100'000;  // the update takes five of the oscillator's periods, 0.3 ms

}  // namespace

// An update that does not come leaves the longest time-out, 0.5 s: the watchdog bites late, but it does.
void start_watchdog() {
  Memory memory;
  set_bits(memory, rcc::control_status, rcc::remove_reset_flags);
  Memory::write(key, key_start);
  Memory::write(key, key_unlock);
  Memory::write(prescaler, prescaler_by_4);
  Memory::write(reload, counts - 1);
  for (std::uint32_t poll = 0; poll < most_polls && Memory::read(status) != 0; ++poll) {
  }
  Memory::write(key, key_feed);
}

void feed_watchdog() {
  Memory::write(key, key_feed);
}

bool watchdog_has_expired() {
  return (Memory::read(rcc::control_status) & rcc::reset_by_watchdog) != 0;
}

}  // namespace striker::bare_metal
