// SPDX-License-Identifier: Apache-2.0
// 20 ms are 14 to 38, over the oscillator's range: within what watchdog.hpp allows. QEMU has none.
#include "firmware/ports/boards/stm32f4/independent_watchdog.hpp"

#include "firmware/ports/bare_metal/watchdog.hpp"
#include "firmware/ports/boards/stm32f4/memory.hpp"

namespace striker::bare_metal {

using stm32f4::Memory;

void start_watchdog() {
  Memory memory;
  stm32f4::iwdg::start(memory, watchdog_timeout_ms);
}

void feed_watchdog() {
  Memory::write(stm32f4::iwdg::key, stm32f4::iwdg::key_feed);
}

bool watchdog_has_expired() {
  return (Memory::read(stm32f4::rcc::control_status) & stm32f4::rcc::reset_by_watchdog) != 0;
}

}  // namespace striker::bare_metal
