// SPDX-License-Identifier: Apache-2.0
// The bit timing of a bxCAN (RM0090, "Bit timing"): a bit is 1 quantum of synchronisation, then two segments, with the
// sample point between them; a quantum is some clocks of APB1. Computed by the compiler, which refuses a clock that has no
// good one: the exact bit rate, and a sample point within 2.5 % of the bit from 75 % (ports/bare_metal/can_bus.hpp says why).
#pragma once

#include <algorithm>
#include <cstdint>

namespace striker::stm32f4 {

struct BitTiming {
  std::uint32_t prescaler = 0;  // clocks a quantum, 1 to 1024; 0: there is none
  std::uint32_t before = 0;     // quanta from the synchronisation to the sample point, 1 to 16
  std::uint32_t after = 0;      // quanta from there to the end, 1 to 8
  std::uint32_t jump = 0;       // the most that a resynchronisation moves it, 1 to 4

  [[nodiscard]] constexpr std::uint32_t quanta() const { return 1 + before + after; }
  [[nodiscard]] constexpr std::uint32_t bit_rate(std::uint32_t clock_hz) const {
    return clock_hz / (prescaler * quanta());
  }
  [[nodiscard]] constexpr std::uint32_t sample_point_permille() const {
    return (1 + before) * 1000 / quanta();
  }
  // The timing register, BTR.
  [[nodiscard]] constexpr std::uint32_t register_value() const {
    return (jump - 1) << 24U | (after - 1) << 20U | (before - 1) << 16U | (prescaler - 1);
  }
};

inline constexpr std::uint32_t wanted_sample_point_permille = 750;
inline constexpr std::uint32_t sample_point_tolerance_permille = 25;

// The timing nearest to the sample point, and of equal ones that with the most quanta.
constexpr BitTiming bit_timing(std::uint32_t clock_hz, std::uint32_t bit_rate) {
  BitTiming best;
  std::uint32_t least_error = sample_point_tolerance_permille + 1;
  for (std::uint32_t quanta = 25; quanta >= 8; --quanta) {
    if (clock_hz % (bit_rate * quanta) != 0) {
      continue;
    }
    for (std::uint32_t after = 2; after <= 8; ++after) {
      const BitTiming timing{.prescaler = clock_hz / (bit_rate * quanta),
                             .before = quanta - 1 - after,
                             .after = after,
                             .jump = std::min(after, std::uint32_t{4})};
      const std::uint32_t point = timing.sample_point_permille();
      const std::uint32_t error =
          std::max(point, wanted_sample_point_permille) - std::min(point, wanted_sample_point_permille);
      if (timing.prescaler <= 1024 && timing.before <= 16 && error < least_error) {
        least_error = error;
        best = timing;
      }
    }
  }
  return best;
}

}  // namespace striker::stm32f4
