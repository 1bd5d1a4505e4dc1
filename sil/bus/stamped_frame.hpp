// SPDX-License-Identifier: Apache-2.0
// A frame with the logical time at which every node on the bus had it.
#pragma once

#include <cstdint>

#include "firmware/can/frame.hpp"

namespace striker::sil {

struct StampedFrame {
  can::Frame frame;
  std::int64_t received_ns = 0;  // since tick 0
};

}  // namespace striker::sil
