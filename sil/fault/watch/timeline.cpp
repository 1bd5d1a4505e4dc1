// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/watch/timeline.hpp"

#include "firmware/core/state.hpp"
#include "sil/fault/link/recode.hpp"

namespace striker::sil {

void FaultTimeline::end_tick(const Snapshot& snapshot) {
  const std::uint32_t tick = snapshot.tick;
  hear(tick);
  const WheelOrders& orders = parts_.drives.orders();
  const bool cut = parts_.drives.cut(tick);
  const bool driven = !cut && (orders[0].torque_Nm != 0.0 || orders[1].torque_Nm != 0.0);
  if (tick < from_) {
    armed_before_ = armed_;
  } else if (tick < end_) {
    drives_cut_ = drives_cut_ || cut;
    zero_ = driven ? std::nullopt : std::optional(zero_.value_or(tick));
    armed_at_end_ = armed_ && !cut;
  } else {
    drove_later_ = drove_later_ || driven;
  }
}

void FaultTimeline::hear(std::uint32_t tick) {
  for (const can::Frame& frame : parts_.at_controller.from_controller()) {
    if (const auto safety = read<can::Safety>(frame); safety && tick >= from_ && tick < end_) {
      limited_ = limited_ || safety->limits != 0;
    }
    const auto status = read<can::Status>(frame);
    if (!status) {
      continue;
    }
    armed_ = status->state == static_cast<std::int32_t>(core::State::active);
    if (status->fault != 0 && !fault_ && tick >= from_ && tick < end_) {
      fault_ = core::name_of(static_cast<core::Fault>(status->fault));
      detected_ = tick;
    }
  }
}

}  // namespace striker::sil
