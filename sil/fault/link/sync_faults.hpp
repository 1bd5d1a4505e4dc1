// SPDX-License-Identifier: Apache-2.0
// Lockstep's clock gone wrong: sync_repeat, sync_freeze, sync_backward, sync_wrap, sync_restart,
// second_simulator. A lost SYNC is `loss` of the message Sync.
//
// The frames are a simulator's own: with a counter that runs on over what was added, so that nothing but the
// content is wrong.
#pragma once

#include "sil/fault/link/frame_fault.hpp"

namespace striker::sil {

[[nodiscard]] std::unique_ptr<FrameFault> make_sync_fault(const TimedFault& fault);

}  // namespace striker::sil
