// SPDX-License-Identifier: Apache-2.0
// A frame of a match as SSL's vision and tracker messages. Red is yellow; the field frame is SSL's own. Robots that were
// sent out are shown where they stand.
#pragma once

#include <string>

#include "sil/match/record/match_frame.hpp"

namespace striker::sil {

// SSL_WrapperPacket: the detection, with the field's geometry if it is asked for.
[[nodiscard]] std::string vision_packet(const MatchFrame& frame, bool with_geometry);

// TrackerWrapperPacket: true places and velocities.
[[nodiscard]] std::string tracker_packet(const MatchFrame& frame);

}  // namespace striker::sil
