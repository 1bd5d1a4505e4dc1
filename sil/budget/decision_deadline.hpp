// SPDX-License-Identifier: Apache-2.0
// From a picture to the torque command that answers it, at worst, in five parts that follow each other:
//
//   picture   the later frame of pose and ball is received: the greater of their responses
//   phase     it just missed a tick, and waits for the next: one period
//   lateness  that tick begins late
//   step      receive, decide, hand over the command
//   command   the command's response from its queueing
//
// The sum holds if the picture's deadline does: then it comes within the decision window, and decides.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/loop/tick.hpp"
#include "sil/budget/response_time.hpp"

namespace striker::sil {

struct ControllerTime {
  std::int64_t lateness_ns = 0;  // of a tick; in lockstep, where SYNC is the tick, the response of SYNC
  std::int64_t step_ns = 0;
};

struct DecisionDeadline {
  std::int64_t picture_ns = 0;
  std::int64_t phase_ns = loop::tick_period_ns;
  ControllerTime controller;
  std::int64_t command_ns = 0;

  [[nodiscard]] std::int64_t total_ns() const {
    return picture_ns + phase_ns + controller.lateness_ns + controller.step_ns + command_ns;
  }
};

// The messages' jitter covers `controller`. Nothing if VisionPose, VisionBall or WheelCommand is not among
// them or has no bound.
[[nodiscard]] std::optional<DecisionDeadline> decision_deadline(const std::vector<BusMessage>& messages,
                                                                const std::vector<MessageResponse>& responses,
                                                                const ControllerTime& controller);

// The lateness of the ticks in lockstep: the response of Sync among messages with `others_ns` of jitter.
// Nothing if Sync is not among them or has no bound.
[[nodiscard]] std::optional<std::int64_t> sync_lateness_ns(std::vector<BusMessage> messages,
                                                           const BusAssumptions& assumptions,
                                                           std::int64_t others_ns);

}  // namespace striker::sil
