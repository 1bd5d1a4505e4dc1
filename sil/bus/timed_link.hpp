// SPDX-License-Identifier: Apache-2.0
// A bus that takes time, between the simulator and any controller in lockstep: frames arbitrate, and the
// controller has in a tick only what was received when that tick's SYNC was.
//
//   t ms          the simulator's frames of tick t are queued (a picture `vision_phase_ns` later)
//   SYNC received the controller steps, on all that was received before
//   step_ns later its frames are queued
//   t + 1 ms      the simulator has what was received until then; its drives act on it in tick t + 1
//
// A frame that still waits when the next of its identifier is queued is replaced, as in a CAN controller's
// mailbox. All time is logical: same input, same bytes and stamps.
#pragma once

#include <optional>

#include "sil/bus/arbitrated_bus.hpp"
#include "sil/bus/controller_link.hpp"

namespace striker::sil {

struct TimedBusOptions {
  std::int64_t bit_ns = 1000;
  std::int64_t step_ns = 50'000;
  std::int64_t vision_phase_ns = 0;  // less than a tick
};

struct TimedBusReport {
  double busy_share = 0.0;  // of all time so far
  std::uint64_t replaced = 0;
  std::uint64_t decisions = 0;  // that answered a picture
  // From the picture's queueing to the reception of the wheel command.
  std::int64_t decision_latency_max_ns = 0;
};

class TimedLink final : public ControllerLink {
 public:
  TimedLink(ControllerLink& controller, const TimedBusOptions& options);

  // Runs the bus until the controller has its SYNC, and does not wait for what it makes of it.
  void send(std::uint32_t tick, std::span<const can::Frame> frames) override;
  // Runs the bus to the end of the tick. The answer is what was received in the tick before.
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override;

  [[nodiscard]] std::optional<std::span<const StampedFrame>> timed_traffic() const override { return seen_; }

  [[nodiscard]] TimedBusReport report() const;

 private:
  // A step of the controller whose answer was not collected yet.
  struct PendingStep {
    std::uint32_t tick;
    std::int64_t sync_ns;  // its SYNC was received
  };

  void queue(const can::Frame& frame, std::int64_t at_ns);
  void run_until_a_step();
  void receive(const SentFrame& sent);
  void begin_step(const can::Frame& sync, std::int64_t at_ns);
  void end_step();

  ControllerLink* controller_;
  TimedBusOptions options_;
  ArbitratedBus bus_;
  std::vector<StampedFrame> seen_;
  std::vector<can::Frame> to_controller_;  // since the last SYNC
  std::vector<can::Frame> to_simulator_;   // in this tick
  std::vector<can::Frame> arrived_;        // in the tick before
  std::vector<can::Frame> reply_;
  std::optional<PendingStep> step_;
  std::int64_t now_ns_ = 0;
  std::int64_t picture_ns_ = 0;
  std::optional<can::Frame> deciding_command_;  // on its way
  TimedBusReport report_;
};

}  // namespace striker::sil
