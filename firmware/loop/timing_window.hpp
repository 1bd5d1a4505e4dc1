// SPDX-License-Identifier: Apache-2.0
// The measured fields of the Timing message: maxima since the last one that was sent.
#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/can/frame_list.hpp"
#include "firmware/can/messages.hpp"

namespace striker::loop {

class TimingWindow {
 public:
  void take_lateness_us(std::int32_t us) { lateness_us_ = std::max(lateness_us_, us); }
  void take_execution_us(std::int32_t us) { execution_us_ = std::max(execution_us_, us); }
  void take_latency_us(std::int32_t us) { latency_us_ = std::max(latency_us_, us); }
  void take_missed(std::uint32_t ticks) {
    overruns_ = std::min(overruns_ + std::min(ticks, greatest), greatest);
  }

  [[nodiscard]] can::Timing message() const {
    return {.lateness_max_us = field(lateness_us_),
            .execution_max_us = field(execution_us_),
            .overruns = static_cast<std::int32_t>(overruns_),
            .latency_max_us = field(latency_us_)};
  }

  void restart_if_among(const can::FrameList& sent) {
    for (const can::Frame& frame : sent.frames()) {
      if (can::is<can::Timing>(frame)) {
        lateness_us_ = execution_us_ = latency_us_ = 0;
      }
    }
  }

 private:
  static constexpr std::uint32_t greatest = can::not_available - 1;

  static std::int32_t field(std::int32_t us) {
    return std::clamp(us, std::int32_t{0}, static_cast<std::int32_t>(greatest));
  }

  std::int32_t lateness_us_ = 0;
  std::int32_t execution_us_ = 0;
  std::int32_t latency_us_ = 0;
  std::uint32_t overruns_ = 0;  // since boot
};

}  // namespace striker::loop
