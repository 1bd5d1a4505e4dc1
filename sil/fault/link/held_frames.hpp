// SPDX-License-Identifier: Apache-2.0
// Frames that come at another time than they should: delay, jitter, replay.
#pragma once

#include "sil/fault/link/frame_fault.hpp"

namespace striker::sil {

[[nodiscard]] std::unique_ptr<FrameFault> make_held_frames(const TimedFault& fault, const Random& random);

}  // namespace striker::sil
