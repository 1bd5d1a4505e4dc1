// SPDX-License-Identifier: Apache-2.0
// WATCHDOG none: nothing ends a hang.
#include "firmware/ports/bare_metal/watchdog.hpp"

namespace striker::bare_metal {

void start_watchdog() {}

void feed_watchdog() {}

bool watchdog_has_expired() {
  return false;
}

}  // namespace striker::bare_metal
