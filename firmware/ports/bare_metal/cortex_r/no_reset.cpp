// SPDX-License-Identifier: Apache-2.0
// For boards whose Cortex-R cannot reset itself alone: it stops, and whoever started it starts it again.
#include "firmware/ports/bare_metal/reset.hpp"

void striker::bare_metal::reset_processor() {
  stop_processor();
}
