// SPDX-License-Identifier: Apache-2.0
// How a node stands on its bus (ISO 11898-1, "Fault confinement"): it counts errors, and takes itself off the
// bus before it disturbs the others for long.
#pragma once

#include <cstdint>

namespace striker::can {

enum class BusHealth : std::uint8_t {
  active,         // both error counters below 128: everything works
  error_passive,  // one of them 128 or more: an unplugged cable, a wrong bit rate, nobody who acknowledges
  bus_off,        // transmit errors above 255: neither sends nor receives until it has recovered
};

}  // namespace striker::can
