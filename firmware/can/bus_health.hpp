// How a CAN controller stands with its bus (ISO 11898-1, fault confinement).
#pragma once

#include <cstdint>

namespace striker::can {

enum class BusHealth : std::uint8_t {
  active,         // takes part, and marks errors actively
  error_passive,  // 128 errors: takes part, but only marks errors passively
  bus_off,        // 256 transmit errors: neither sends nor receives until it is recovered
};

}  // namespace striker::can
