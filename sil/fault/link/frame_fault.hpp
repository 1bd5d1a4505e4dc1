// SPDX-License-Identifier: Apache-2.0
// A fault of the bus: what it makes of a tick's frames on their way to the controller and back.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "firmware/can/frame.hpp"
#include "sil/fault/plan/fault_plan.hpp"
#include "sil/world/random.hpp"

namespace striker::sil {

class FrameFault {
 public:
  virtual ~FrameFault() = default;
  // Once a tick each, in this order. In lockstep SYNC is the last of the frames to the controller.
  virtual void to_controller(std::uint32_t /*tick*/, std::vector<can::Frame>& /*frames*/) {}
  virtual void from_controller(std::uint32_t /*tick*/, std::vector<can::Frame>& /*frames*/) {}
};

// Nothing for a fault of another place than frames. Every draw is from `random`, and within the window.
[[nodiscard]] std::unique_ptr<FrameFault> make_frame_fault(const TimedFault& fault, const Random& random);

// Sync and EndOfTick are the simulator's clock and on no real robot's bus: "all" leaves them out.
[[nodiscard]] bool is_lockstep(const can::Frame& frame);

[[nodiscard]] inline bool concerns(const Fault& fault, const can::Frame& frame) {
  return fault.message ? *fault.message == frame.id : !is_lockstep(frame);
}

}  // namespace striker::sil
