// SPDX-License-Identifier: Apache-2.0
// When something last came, and whether that is recent enough.
#pragma once

#include <cstdint>

namespace striker::core {

struct Freshness {
  bool ever = false;
  std::uint32_t tick = 0;

  void feed(std::uint32_t now) { *this = {true, now}; }
  // Ticks wrap, and so does their difference: "recent" holds for 2^32 ticks (49 days) after `feed`.
  [[nodiscard]] bool within(std::uint32_t now, std::uint32_t limit_ticks) const {
    return ever && now - tick <= limit_ticks;
  }
};

}  // namespace striker::core
