// SPDX-License-Identifier: Apache-2.0
// The identifiers that a controller listens to: no other frame can move it. A port filters by them. The only
// list: operator, vision, team, Sync, what the drives tell, and what only a controller sends: a second one on the bus is
// noticed by that.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "firmware/can/drives/drive_protocol.hpp"
#include "firmware/can/messages.hpp"

namespace striker::can {

template <DriveProtocol Drives>
inline constexpr auto controller_receives = [] {
  constexpr std::array<std::uint16_t, 8> always = {layout<EmergencyStop>.info.id, layout<Sync>.info.id,
                                                   layout<ModeCommand>.info.id,   layout<VisionPose>.info.id,
                                                   layout<VisionBall>.info.id,    layout<WheelOrder>.info.id,
                                                   layout<MotionOrder>.info.id,   layout<Status>.info.id};
  std::array<std::uint16_t, always.size() + Drives::receives.size() + Drives::sends.size()> all{};
  auto* end = std::copy(always.begin(), always.end(), all.begin());
  end = std::copy(Drives::receives.begin(), Drives::receives.end(), end);
  std::copy(Drives::sends.begin(), Drives::sends.end(), end);
  return all;
}();

}  // namespace striker::can
