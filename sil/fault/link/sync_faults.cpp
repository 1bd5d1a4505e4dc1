// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/link/sync_faults.hpp"

#include <optional>
#include <utility>

#include "sil/fault/link/recode.hpp"

namespace striker::sil {

namespace {

constexpr std::uint32_t low_31_bits = 0x7FFFFFFF;

class SyncFault final : public FrameFault {
 public:
  explicit SyncFault(const TimedFault& fault) : fault_(fault) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    std::vector<can::Frame> passed;
    for (const can::Frame& frame : frames) {
      const auto sync = read<can::Sync>(frame);
      if (!sync) {
        passed.push_back(frame);
        continue;
      }
      if (!started_) {
        counter_.next = can::counter_of(frame);
        started_ = true;
      }
      const auto told =
          fault_.lasts(tick) ? changed(static_cast<std::uint32_t>(sync->tick), tick) : sync->tick;
      const bool repeats = fault_.fault.kind == FaultKind::sync_repeat && fault_.lasts(tick);
      for (std::uint32_t i = 0; i < (repeats ? 1 + fault_.fault.count : 1); ++i) {
        passed.push_back(can::send(can::Sync{.tick = told}, counter_));
      }
    }
    frames = std::move(passed);
  }

 private:
  // The tick that SYNC tells instead of this one.
  [[nodiscard]] std::int32_t changed(std::uint32_t honest, std::uint32_t tick) const {
    const std::uint32_t since = tick - fault_.from;
    std::uint32_t told = honest;
    switch (fault_.fault.kind) {
      case FaultKind::sync_freeze:
        told = honest - since;
        break;
      case FaultKind::sync_backward:
        told = honest > fault_.fault.count ? honest - fault_.fault.count : 1;
        break;
      case FaultKind::sync_wrap:
        told = low_31_bits - fault_.fault.count + since;
        break;
      case FaultKind::sync_restart:
        told = since == 0 ? 0 : honest;
        break;
      default:
        break;
    }
    return static_cast<std::int32_t>(told & low_31_bits);
  }

  TimedFault fault_;
  can::SendCounter counter_;
  bool started_ = false;
};

class SecondSimulator final : public FrameFault {
 public:
  explicit SecondSimulator(const TimedFault& fault) : fault_(fault) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    if (fault_.lasts(tick)) {
      frames.push_back(
          can::send(can::Sync{.tick = static_cast<std::int32_t>(tick - fault_.from + 1)}, counter_));
    }
  }

 private:
  TimedFault fault_;
  can::SendCounter counter_;
};

}  // namespace

std::unique_ptr<FrameFault> make_sync_fault(const TimedFault& fault) {
  if (fault.fault.kind == FaultKind::second_simulator) {
    return std::make_unique<SecondSimulator>(fault);
  }
  return std::make_unique<SyncFault>(fault);
}

}  // namespace striker::sil
