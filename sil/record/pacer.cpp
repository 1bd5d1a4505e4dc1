// SPDX-License-Identifier: Apache-2.0
#include "sil/record/pacer.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace striker::sil {

void Pacer::begin_tick() {
  const auto wake = clock_.wait();
  missed_ += wake.missed;
  lateness_max_ns_ = std::max(lateness_max_ns_, wake.lateness_ns);
  lateness_sum_ns_ += wake.lateness_ns;
  ++ticks_;
}

void Pacer::end_run() {
  const auto ticks = static_cast<double>(std::max<std::int64_t>(ticks_, 1));
  fmt::print("simulator's clock: {} ticks, {} periods missed, lateness mean {:.1f} us, max {:.1f} us\n",
             ticks_, missed_, static_cast<double>(lateness_sum_ns_) / ticks / 1e3,
             static_cast<double>(lateness_max_ns_) / 1e3);
}

}  // namespace striker::sil
