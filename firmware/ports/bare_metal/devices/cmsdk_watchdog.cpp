// SPDX-License-Identifier: Apache-2.0
// The watchdog of Arm's MPS2 and MPS3 boards (CMSDK APB watchdog: Arm DDI 0479, 4.5), whose interrupt is the
// NMI. STRIKER_WATCHDOG says where, STRIKER_WATCHDOG_HZ what it counts. A reset clears its interrupt: it shows
// in the NMI alone.
#include "firmware/ports/bare_metal/watchdog.hpp"

namespace striker::bare_metal {

namespace {

struct Registers {
  std::uint32_t load;
  std::uint32_t value;
  std::uint32_t control;
  std::uint32_t clear_interrupt;
  std::uint32_t raw_interrupt;
};

constexpr std::uint32_t control_interrupt = 1U << 0U;
constexpr std::uint32_t control_reset = 1U << 1U;
constexpr std::uintptr_t lock_offset = 0xC00;
constexpr std::uint32_t unlocked = 0x1ACCE551;
constexpr std::uint32_t counts = STRIKER_WATCHDOG_HZ / 1000 * watchdog_timeout_ms;

volatile Registers& registers() {
  return *reinterpret_cast<volatile Registers*>(STRIKER_WATCHDOG);
}

volatile std::uint32_t& lock() {
  return *reinterpret_cast<volatile std::uint32_t*>(STRIKER_WATCHDOG + lock_offset);
}

}  // namespace

void start_watchdog() {
  lock() = unlocked;
  registers().load = counts;
  registers().control = control_interrupt | control_reset;
}

// The register lock stays open: to feed through it would take three writes a tick.
void feed_watchdog() {
  registers().clear_interrupt = 1;
}

bool watchdog_has_expired() {
  return (registers().raw_interrupt & 1U) != 0;
}

}  // namespace striker::bare_metal
