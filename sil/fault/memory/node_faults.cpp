// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/memory/node_faults.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "firmware/can/messages.hpp"
#include "sil/fault/memory/bit_flips.hpp"

namespace striker::sil {

namespace {

// Off the bus no frame passes, SYNC included; error passive, every one.
class Health final : public FrameFault {
 public:
  Health(const TimedFault& fault, InProcessLink& controller) : fault_(fault), controller_(&controller) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    controller_->set_health(fault_.lasts(tick) ? health() : can::BusHealth::active);
    lose(tick, frames);
  }
  void from_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override { lose(tick, frames); }

 private:
  [[nodiscard]] can::BusHealth health() const {
    switch (fault_.fault.kind) {
      case FaultKind::bus_off:
        return can::BusHealth::bus_off;
      case FaultKind::error_passive:
        return can::BusHealth::error_passive;
      default:
        return can::BusHealth::active;
    }
  }

  void lose(std::uint32_t tick, std::vector<can::Frame>& frames) const {
    if (fault_.lasts(tick) && fault_.fault.kind != FaultKind::error_passive) {
      frames.clear();
    }
  }

  TimedFault fault_;
  InProcessLink* controller_;
};

// The process stands still, and its port's queue goes on to fill. The first tick after it brings all that was kept,
// with its age, and as the port's contract has it (firmware/loop/bus.hpp): emergency stops first, losses counted.
class Stall final : public FrameFault {
 public:
  Stall(const TimedFault& fault, InProcessLink& controller) : fault_(fault), controller_(&controller) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    controller_->stand_still(fault_.lasts(tick));
    if (fault_.lasts(tick)) {
      for (const can::Frame& frame : frames) {
        keep(frame, tick);
      }
      frames.clear();
    } else if (!stops_.empty() || !queue_.empty()) {
      std::vector<can::Frame> burst;
      release(stops_, tick, burst);
      release(queue_, tick, burst);
      burst.insert(burst.end(), frames.begin(), frames.end());
      frames = std::move(burst);
    }
  }

 private:
  struct Waiting {
    can::Frame frame;
    std::uint32_t since = 0;
  };

  void keep(const can::Frame& frame, std::uint32_t tick) {
    if (can::is<can::EmergencyStop>(frame)) {
      stops_.push_back({frame, tick});
    } else if (fault_.fault.count == 0 || queue_.size() < fault_.fault.count) {
      queue_.push_back({frame, tick});
    } else {
      controller_->lose(1);
    }
  }

  static void release(std::vector<Waiting>& waiting, std::uint32_t tick, std::vector<can::Frame>& frames) {
    constexpr std::uint32_t oldest_ms = 255;
    for (const Waiting& late : waiting) {
      frames.push_back(late.frame);
      frames.back().age_ms = static_cast<std::uint8_t>(std::min(tick - late.since, oldest_ms));
    }
    waiting.clear();
  }

  TimedFault fault_;
  InProcessLink* controller_;
  std::vector<Waiting> stops_;
  std::vector<Waiting> queue_;
};

class StateFlips final : public FrameFault {
 public:
  StateFlips(const TimedFault& fault, const Random& random, InProcessLink& controller)
      : fault_(fault), random_(random), controller_(&controller) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>&) override {
    for (std::uint32_t i = 0; tick == fault_.from && i < fault_.fault.count; ++i) {
      const auto memory = controller_->memory();
      flip(memory, random_.below(bits_of(memory)));
    }
  }

 private:
  TimedFault fault_;
  Random random_;
  InProcessLink* controller_;
};

}  // namespace

std::unique_ptr<FrameFault> make_node_fault(const TimedFault& fault, const Random& random,
                                            InProcessLink& controller) {
  switch (fault.fault.kind) {
    case FaultKind::bus_off:
    case FaultKind::error_passive:
    case FaultKind::interface_down:
      return std::make_unique<Health>(fault, controller);
    case FaultKind::stall:
      return std::make_unique<Stall>(fault, controller);
    case FaultKind::state_flips:
      return std::make_unique<StateFlips>(fault, random, controller);
    default:
      return nullptr;
  }
}

}  // namespace striker::sil
