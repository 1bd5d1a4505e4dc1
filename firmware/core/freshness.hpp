// SPDX-License-Identifier: Apache-2.0
// When something last came, and whether that is recent enough.
//
// Ticks wrap, and so does their difference: something that is asked for less often than once in 2^31 ticks would
// look recent again. Whoever asks once a tick uses `expire`, which forgets what has become too old: it never
// comes back by itself.
#pragma once

#include <cstdint>

namespace striker::core {

class Freshness {
 public:
  void feed(std::uint32_t now) {
    ever_ = 1;
    tick_ = now;
  }
  void forget() { *this = {}; }

  [[nodiscard]] bool ever() const { return ever_ != 0; }
  [[nodiscard]] std::uint32_t tick() const { return tick_; }

  // Not in the future, and at most `limit_ticks` ago.
  [[nodiscard]] bool within(std::uint32_t now, std::uint32_t limit_ticks) const {
    return ever_ != 0 && now - tick_ <= limit_ticks;
  }
  // The same; once it is false it stays false until the next `feed`.
  bool expire(std::uint32_t now, std::uint32_t limit_ticks) {
    if (!within(now, limit_ticks)) {
      forget();
    }
    return ever_ != 0;
  }

 private:
  std::uint32_t ever_ = 0;  // a whole word: the state has no padding (seal.hpp)
  std::uint32_t tick_ = 0;
};

}  // namespace striker::core
