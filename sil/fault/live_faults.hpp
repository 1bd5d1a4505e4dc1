// SPDX-License-Identifier: Apache-2.0
// Faults that begin when somebody asks for them while a run goes on: a decorator of any other link. As long as nobody has,
// every frame passes as it is.
//
// Those of frames and of the controller's node can begin so, with the table's values (plan/fault_kinds.hpp); not
// - masquerade and replay, which need a message that nobody named;
// - emergency_stop, which an operator presses (scenario/operator.hpp): his frame is on the bus and in its log;
// - weight_flips: the weights serve all controllers of the process, and those who look on;
// - second_controller and brown_out, which are no faults of frames.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sil/bus/in_process_link.hpp"
#include "sil/fault/link/frame_fault.hpp"

namespace striker::sil {

class LiveFaults final : public ControllerLink {
 public:
  // `controller` is the same link where that controller may have faults, or nothing; `in_process`: it is no real bus. Both
  // outlive it.
  LiveFaults(ControllerLink& link, InProcessLink* controller, bool in_process, std::uint64_t seed)
      : link_(&link), controller_(controller), in_process_(in_process), seed_(seed) {}

  // From the next tick on. False, and nothing begins, if the kind is none of the above, not for this bus, or
  // `most_at_once` go on.
  bool begin(FaultKind kind, std::uint32_t for_ticks);

  void send(std::uint32_t tick, std::span<const can::Frame> frames) override;
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override;
  [[nodiscard]] std::optional<std::span<const StampedFrame>> timed_traffic() const override {
    return link_->timed_traffic();
  }

  [[nodiscard]] InProcessLink* controller() const { return controller_; }

  static constexpr std::size_t most_at_once = 16;

 private:
  struct Going {
    std::uint32_t forgotten;  // tick
    std::unique_ptr<FrameFault> fault;
  };

  ControllerLink* link_;
  InProcessLink* controller_;
  bool in_process_;
  std::uint64_t seed_;
  std::uint64_t begun_ = 0;  // each draws from a stream of its own
  std::uint32_t next_tick_ = 0;
  std::vector<Going> faults_;
  std::vector<can::Frame> frames_;
};

// Whether it can begin in a run, on a bus in this process or of SocketCAN.
[[nodiscard]] bool can_begin_live(FaultKind kind, bool in_process);

// The controller behind a link if it is in this process and may have faults, whether live ones stand before it or not.
[[nodiscard]] InProcessLink* controller_behind(ControllerLink& link);

}  // namespace striker::sil
