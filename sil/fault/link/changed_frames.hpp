// SPDX-License-Identifier: Apache-2.0
// Frames that are lost, damaged or out of order: loss, picture_loss, flip_bits, wrong_length, reorder.
#pragma once

#include "sil/fault/link/frame_fault.hpp"

namespace striker::sil {

[[nodiscard]] std::unique_ptr<FrameFault> make_changed_frames(const TimedFault& fault, const Random& random);

}  // namespace striker::sil
