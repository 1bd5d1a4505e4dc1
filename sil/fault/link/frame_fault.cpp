// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/link/frame_fault.hpp"

#include "firmware/can/messages.hpp"
#include "sil/fault/link/changed_frames.hpp"
#include "sil/fault/link/held_frames.hpp"
#include "sil/fault/link/injected_frames.hpp"
#include "sil/fault/link/sync_faults.hpp"

namespace striker::sil {

bool is_lockstep(const can::Frame& frame) {
  return can::is<can::Sync>(frame) || can::is<can::EndOfTick>(frame);
}

std::unique_ptr<FrameFault> make_frame_fault(const TimedFault& fault, const Random& random) {
  using enum FaultKind;
  switch (fault.fault.kind) {
    case sync_repeat:
    case sync_freeze:
    case sync_backward:
    case sync_wrap:
    case sync_restart:
    case second_simulator:
      return make_sync_fault(fault);
    case loss:
    case picture_loss:
    case flip_bits:
    case wrong_length:
    case reorder:
      return make_changed_frames(fault, random);
    case replay:
    case delay:
    case jitter:
      return make_held_frames(fault, random);
    case masquerade:
    case duplicate:
    case babble:
    case emergency_stop:
      return make_injected_frames(fault, random);
    default:
      return nullptr;
  }
}

}  // namespace striker::sil
