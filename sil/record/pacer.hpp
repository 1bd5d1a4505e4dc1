// SPDX-License-Identifier: Apache-2.0
// Lets a run go no faster than the wall clock: every tick waits for its absolute deadline.
#pragma once

#include <cstdint>

#include "firmware/host/periodic_clock.hpp"
#include "firmware/loop/tick.hpp"
#include "sil/record/observer.hpp"

namespace striker::sil {

class Pacer final : public Observer {
 public:
  void begin_tick() override;
  // Says on stdout what became of the deadlines.
  void end_run() override;

 private:
  host::MonotonicClock monotonic_;
  host::PeriodicClock clock_{monotonic_, loop::tick_period_ns};
  std::int64_t ticks_ = 0;
  std::uint64_t missed_ = 0;
  std::int64_t lateness_max_ns_ = 0;
  std::int64_t lateness_sum_ns_ = 0;
};

}  // namespace striker::sil
