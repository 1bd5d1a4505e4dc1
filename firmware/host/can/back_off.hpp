// SPDX-License-Identifier: Apache-2.0
// How often something that fails is tried again: at once, then after pauses that double from 100 ms to 1 s.
#pragma once

#include <algorithm>
#include <chrono>

namespace striker::host {

class BackOff {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Whether to try now; the next pause begins then.
  [[nodiscard]] bool due(Time now) {
    if (now < next_) {
      return false;
    }
    next_ = now + pause_;
    pause_ = std::min(2 * pause_, longest);
    return true;
  }
  void reset() { *this = {}; }

 private:
  static constexpr std::chrono::milliseconds longest{1000};

  std::chrono::milliseconds pause_{100};
  Time next_{};
};

}  // namespace striker::host
