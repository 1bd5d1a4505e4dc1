// SPDX-License-Identifier: Apache-2.0
// Frames that nobody should have sent: masquerade, duplicate, babble, emergency_stop. A bus is heard by all: what is
// injected reaches the controller and its drives in the same tick, before the honest frames.
#pragma once

#include "sil/fault/link/frame_fault.hpp"

namespace striker::sil {

// Random bytes in frames that the fault concerns, each of its message's length.
class RandomFrames {
 public:
  RandomFrames(const Fault& fault, const Random& random);
  [[nodiscard]] can::Frame draw();

 private:
  std::vector<can::Frame> forms_;
  Random random_;
};

[[nodiscard]] std::unique_ptr<FrameFault> make_injected_frames(const TimedFault& fault, const Random& random);

}  // namespace striker::sil
