// SPDX-License-Identifier: Apache-2.0
// The field as SSL's geometry message.
#pragma once

#include "sil/match/record/ssl/proto_message.hpp"

namespace striker::sil {

// SSL_GeometryData, with the lines and the circle that viewers draw.
[[nodiscard]] ProtoMessage field_geometry();

}  // namespace striker::sil
