// SPDX-License-Identifier: Apache-2.0
// How a processor's run ends: two functions that start-up code implements, cortex_m/startup.cpp both,
// cortex_r/startup.cpp the second. Called in any state, also from an exception of the highest priority.
#pragma once

namespace striker::bare_metal {

// Resets the processor, RAM kept. A Cortex-R has no reset of its own: its board implements this one, and one
// that cannot lists cortex_r/no_reset.cpp among its SOURCES, which stops instead.
[[noreturn]] void reset_processor();

// Stops for good, interrupts masked. Nothing goes out any more.
[[noreturn]] void stop_processor();

}  // namespace striker::bare_metal
