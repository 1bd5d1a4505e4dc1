// How the simulator reaches the controller: one tick's frames out, the controller's answer back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "firmware/can/frame.hpp"

namespace striker::sil {

class ControllerLink {
 public:
  virtual ~ControllerLink() = default;

  // Sends the frames of tick `tick` in their order, and appends the controller's answer to `answer`. In
  // lockstep SYNC is the last frame of `sent` and the wheel command with the tick's low bits the last of the
  // answer; an unanswered tick appends nothing. On a wall clock: whatever has come by now.
  virtual void exchange(std::uint32_t tick, std::span<const can::Frame> sent,
                        std::vector<can::Frame>& answer) = 0;
};

}  // namespace striker::sil
