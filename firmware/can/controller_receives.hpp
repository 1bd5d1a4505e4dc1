// SPDX-License-Identifier: Apache-2.0
// The identifiers that the controller listens to: no other frame can move it. A port filters by them.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/can/messages.hpp"

namespace striker::can {

inline constexpr std::array<std::uint16_t, 6> controller_receives = {
    layout<EmergencyStop>.info.id, layout<Sync>.info.id,       layout<ModeCommand>.info.id,
    layout<WheelState>.info.id,    layout<VisionPose>.info.id, layout<VisionBall>.info.id};

}  // namespace striker::can
