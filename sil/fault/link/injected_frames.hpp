// SPDX-License-Identifier: Apache-2.0
// Frames that nobody should have sent: masquerade, duplicate, babble, emergency_stop. A bus is heard by all: what is
// injected reaches the controller and its drives in the same tick, before the honest frames.
#pragma once

#include "sil/fault/link/frame_fault.hpp"

namespace striker::sil {

[[nodiscard]] std::unique_ptr<FrameFault> make_injected_frames(const TimedFault& fault, const Random& random);

}  // namespace striker::sil
