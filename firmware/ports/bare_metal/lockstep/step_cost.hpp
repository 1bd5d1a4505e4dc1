// SPDX-License-Identifier: Apache-2.0
// What the dearest step cost: from the tick with its frames to the controller's answer, command gate included, without
// the bus. A debugger, or tools/pil, reads it from `greatest_step_counts`.
//
// Cortex-M: counts of SysTick, which the board's clock has to be (cortex_m/systick_clock.cpp); right for steps below
// 1 ms. Cortex-R: the cycle counter (Armv7-R Architecture Reference Manual, "The Performance Monitors Extension").
// With QEMU's `-icount shift=0` time is an instruction a nanosecond, so these count instructions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "firmware/can/frame_list.hpp"
#include "firmware/loop/tick.hpp"

#if __ARM_ARCH_PROFILE != 'R'
#include "firmware/ports/bare_metal/cortex_m/systick.hpp"
#endif

extern "C" {
extern std::uint32_t greatest_step_counts;
}

namespace striker::bare_metal {

#if __ARM_ARCH_PROFILE == 'R'

inline void start_cost_counter() {
  constexpr std::uint32_t enable = 1U << 0U;
  constexpr std::uint32_t cycle_counter = 1U << 31U;
  asm volatile("mcr p15, 0, %0, c9, c12, 0" : : "r"(enable));
  asm volatile("mcr p15, 0, %0, c9, c12, 1" : : "r"(cycle_counter));
}

inline std::uint32_t cost_counter() {
  std::uint32_t count = 0;
  asm volatile("mrc p15, 0, %0, c9, c13, 0" : "=r"(count));
  return count;
}

inline std::uint32_t counts_between(std::uint32_t begin, std::uint32_t end) {
  return end - begin;
}

#else

inline void start_cost_counter() {}

inline std::uint32_t cost_counter() {
  return cortex_m::systick.value;
}

// It counts down, and begins anew every tick.
inline std::uint32_t counts_between(std::uint32_t begin, std::uint32_t end) {
  return begin - end + (end > begin ? cortex_m::systick.reload + 1 : 0);
}

#endif

// Around a source of ticks (loop/tick_loop.hpp).
template <class Ticks>
class MeasuredTicks {
 public:
  explicit constexpr MeasuredTicks(Ticks ticks) : ticks_(std::move(ticks)) {}

  template <class BusType>
  std::optional<loop::Tick> next(BusType& bus) {
    auto tick = ticks_.next(bus);
    if (tick) {
      begin_ = cost_counter();
    }
    return tick;
  }

  void end(can::FrameList& sent) {
    greatest_step_counts = std::max(greatest_step_counts, counts_between(begin_, cost_counter()));
    ticks_.end(sent);
  }
  void done() { ticks_.done(); }

  [[nodiscard]] Ticks& source() { return ticks_; }

 private:
  Ticks ticks_;
  std::uint32_t begin_ = 0;
};

}  // namespace striker::bare_metal
