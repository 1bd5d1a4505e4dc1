// SPDX-License-Identifier: Apache-2.0
// What reset does to memory before `main`, and how deep the stack has been since.
#pragma once

#include <cstdint>

namespace striker::bare_metal {

// Copies .data, clears .bss, and paints the stack below the caller.
void prepare_memory();

// The lowest words of the stack still hold the paint: it has never been full since reset. Four loads.
[[nodiscard]] bool stack_is_intact();

// What the RAM held at power-on, hashed: each chip's own, with some bits that differ each time (SRAM start-up values).
// It begins the challenges (core/supervision/consent.hpp), so that a recording of another run does not fit; it is no secret. A
// board with a random number generator has a better seed. Never 0.
[[nodiscard]] std::uint32_t power_on_noise();

// The stack that was in use at its deepest since reset, in bytes.
[[nodiscard]] std::uint32_t stack_high_water_bytes();

}  // namespace striker::bare_metal
