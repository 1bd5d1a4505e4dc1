// SPDX-License-Identifier: Apache-2.0
// When the next tick may begin: pause, single steps, and a speed against the wall clock. It changes no logical time, so
// nothing that a run writes.
//
//   while (!gate.is_open()) { ... }   // paused: ask again after a while
//   gate.pace();                      // then once a tick: sleeps until it is due
#pragma once

#include <cstdint>

#include "firmware/host/periodic_clock.hpp"

namespace striker::sil {

class TimeGate {
 public:
  // The clock outlives it. `speed` times real time; 0: as fast as it goes.
  TimeGate(host::AbsoluteClock& clock, double speed) : clock_(&clock), speed_(speed) {}

  void pause() {
    paused_ = true;
    steps_ = 0;
  }
  void run() {
    paused_ = false;
    due_ns_ = 0;
  }
  // So many ticks pass, then it is paused.
  void step(std::uint32_t ticks) {
    paused_ = true;
    steps_ += ticks;
  }
  void set_speed(double speed) {
    speed_ = speed;
    due_ns_ = 0;
  }

  [[nodiscard]] bool is_paused() const { return paused_; }
  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] bool is_open() const { return !paused_ || steps_ > 0; }

  // Ticks that are due within half a millisecond are not slept for: sleeping is coarser than that. More than a tenth of
  // a second that was missed is not caught up with.
  void pace() {
    if (paused_) {
      steps_ -= steps_ > 0 ? 1 : 0;
      due_ns_ = 0;
      return;
    }
    if (speed_ == 0.0) {
      return;
    }
    const std::int64_t now_ns = clock_->now_ns();
    due_ns_ = due_ns_ == 0 ? now_ns : due_ns_ + static_cast<std::int64_t>(tick_ns / speed_);
    if (due_ns_ - now_ns > least_sleep_ns) {
      clock_->sleep_until_ns(due_ns_);
      see_lateness(clock_->now_ns());
      return;
    }
    see_lateness(now_ns);
    due_ns_ = now_ns - due_ns_ > most_caught_up_ns ? now_ns : due_ns_;
  }

  // The most by which a tick began late against this speed, since it was asked before.
  [[nodiscard]] std::int64_t take_lateness_max_us() {
    const std::int64_t late_ns = lateness_max_ns_;
    lateness_max_ns_ = 0;
    return late_ns / 1000;
  }

 private:
  static constexpr double tick_ns = 1e6;
  static constexpr std::int64_t least_sleep_ns = 500'000;
  static constexpr std::int64_t most_caught_up_ns = 100'000'000;

  void see_lateness(std::int64_t now_ns) {
    lateness_max_ns_ = now_ns - due_ns_ > lateness_max_ns_ ? now_ns - due_ns_ : lateness_max_ns_;
  }

  host::AbsoluteClock* clock_;
  double speed_;
  bool paused_ = false;
  std::uint32_t steps_ = 0;
  std::int64_t due_ns_ = 0;  // 0: the next tick is due when it comes
  std::int64_t lateness_max_ns_ = 0;
};

}  // namespace striker::sil
