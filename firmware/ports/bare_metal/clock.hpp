// A port's timer: 1 ms ticks, and the time within one.
#pragma once

#include <cstdint>

namespace striker::bare_metal {

void start_ticks();

// Ticks since the start; wraps.
[[nodiscard]] std::uint32_t ticks();

// Microseconds since the last tick.
[[nodiscard]] std::uint32_t since_tick_us();

}  // namespace striker::bare_metal
