// SPDX-License-Identifier: Apache-2.0
// The system watchdog timer as the board's watchdog. It raises no exception: its reset goes to the platform management
// unit, whose firmware resets what it is configured to, the whole chip as a rule, and with it the fault's record. It cannot
// be stopped without its key.
#include "firmware/ports/boards/zcu102-r5/swdt.hpp"

#include "firmware/ports/bare_metal/watchdog.hpp"

namespace striker::bare_metal {

namespace {

constexpr std::uintptr_t base = 0xFF150000;

volatile std::uint32_t& mode = *reinterpret_cast<volatile std::uint32_t*>(base + 0x00);
volatile std::uint32_t& control = *reinterpret_cast<volatile std::uint32_t*>(base + 0x04);
volatile std::uint32_t& restart = *reinterpret_cast<volatile std::uint32_t*>(base + 0x08);
volatile std::uint32_t& status = *reinterpret_cast<volatile std::uint32_t*>(base + 0x0C);

}  // namespace

void start_watchdog() {
  control = zcu102::swdt_control(STRIKER_WATCHDOG_CLOCK_HZ, watchdog_timeout_ms);
  feed_watchdog();
  mode = zcu102::swdt_run;
}

void feed_watchdog() {
  restart = zcu102::swdt_restart_key;
}

bool watchdog_has_expired() {
  return (status & zcu102::swdt_expired) != 0;
}

}  // namespace striker::bare_metal
