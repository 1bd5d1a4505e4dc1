// SPDX-License-Identifier: Apache-2.0
// The watchdog of Nordic's nRF51 (nRF51 Series Reference Manual 3.0, chapters 12 and 24): on the 32.768 kHz clock, which it
// starts by itself, and not to be stopped once it runs. It resets at once: the reset's reason tells. QEMU has neither.
#include "firmware/ports/bare_metal/watchdog.hpp"

namespace striker::bare_metal {

namespace {

volatile std::uint32_t& at(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

constexpr std::uintptr_t reset_reason = 0x40000400;
constexpr std::uintptr_t start = 0x40010000;
constexpr std::uintptr_t reload_value = 0x40010504;
constexpr std::uintptr_t reload_enable = 0x40010508;
constexpr std::uintptr_t configuration = 0x4001050C;
constexpr std::uintptr_t reload_request = 0x40010600;

constexpr std::uint32_t reason_watchdog = 1U << 1U;
constexpr std::uint32_t all_reasons = 0xFFFFFFFF;
constexpr std::uint32_t first_request = 1U << 0U;
constexpr std::uint32_t runs_while_asleep = 1U << 0U;
constexpr std::uint32_t reload = 0x6E524635;
constexpr std::uint32_t counts = 32768 * watchdog_timeout_ms / 1000;

}  // namespace

void start_watchdog() {
  at(reset_reason) = all_reasons;  // each bit is cleared by writing 1
  at(reload_value) = counts - 1;
  at(reload_enable) = first_request;
  at(configuration) = runs_while_asleep;
  at(start) = 1;
}

void feed_watchdog() {
  at(reload_request) = reload;
}

bool watchdog_has_expired() {
  return (at(reset_reason) & reason_watchdog) != 0;
}

}  // namespace striker::bare_metal
