// The independent check of every wheel command, after everything else and from the facts alone: what the
// supervisor, the policy and the loops wanted does not count here.
#pragma once

#include "firmware/can/messages.hpp"

namespace striker::core {

// A wheel this fast must not be driven further: 15 % beyond the top rim speed.
inline constexpr std::int32_t overspeed_mm_s = 2933;

struct DriveFacts {
  bool armed = false;  // state active, no fault latched
  bool vision_fresh = false;
  bool wheels_fresh = false;
  can::WheelState wheels;  // as measured
};

// `none` if the command may go out as it is; otherwise the fault to latch, and the command must be all zero.
[[nodiscard]] can::Fault check_command(const can::WheelCommand& command, const DriveFacts& facts);

}  // namespace striker::core
