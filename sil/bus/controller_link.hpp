// SPDX-License-Identifier: Apache-2.0
// How the simulator reaches one controller: a tick's frames out, then the controller's answer back.
//
// `send` does not wait for the controller, `collect` does: a scenario with ten controllers sends to all, then
// collects from all, and waits for the slowest instead of for the sum. Ticks rise by one from 0; each has one
// `send` and then one `collect`.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "firmware/can/frame.hpp"
#include "sil/bus/stamped_frame.hpp"

namespace striker::sil {

class ControllerLink {
 public:
  virtual ~ControllerLink() = default;

  // Sends the frames of tick `tick` in their order. In lockstep SYNC(tick) is the last of them.
  virtual void send(std::uint32_t tick, std::span<const can::Frame> frames) = 0;

  // Appends the controller's answer to `answer`. In lockstep this waits for the end of the answer
  // (sil/bus/end_of_tick.hpp); an unanswered tick appends nothing. On a wall clock: whatever has come by now.
  virtual void collect(std::uint32_t tick, std::vector<can::Frame>& answer) = 0;

  // Everything that was received in the last tick, with its stamps, in the bus's order, where the bus takes
  // time; valid until the next `send`. Nothing where it takes none: then every frame has the tick's time.
  [[nodiscard]] virtual std::optional<std::span<const StampedFrame>> timed_traffic() const { return {}; }
};

}  // namespace striker::sil
