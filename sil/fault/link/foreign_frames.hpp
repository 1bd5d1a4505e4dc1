// SPDX-License-Identifier: Apache-2.0
// Frames of a real bus that are no classic data frames with 11-bit identifiers: remote_frames, extended_frames,
// fd_frames. They go onto the interface itself, as can::Frame cannot say them.
#pragma once

#include <string>

#include "sil/fault/link/frame_fault.hpp"

namespace striker::sil {

// Nothing for a fault of another kind. Throws std::runtime_error that names the interface and the way out.
[[nodiscard]] std::unique_ptr<FrameFault> make_foreign_frames(const TimedFault& fault, const Random& random,
                                                              const std::string& interface);

}  // namespace striker::sil
