// SPDX-License-Identifier: Apache-2.0
// One picture of the camera: where robot and ball were.
#pragma once

#include <cstdint>

#include "firmware/core/estimation/angle.hpp"

namespace striker::core {

// Without padding: it is part of the sealed state (seal.hpp).
struct Picture {
  std::int32_t number = 0;
  Vector robot_um;
  std::int32_t heading = 0;  // a binary angle
  Vector ball_um;
};

}  // namespace striker::core
