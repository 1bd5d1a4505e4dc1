// SPDX-License-Identifier: Apache-2.0
// No board: 1,000 ticks without waiting, on a bus where nobody else is.
#include "own_port.hpp"

namespace own_port {

bool wait_for_tick(std::uint32_t& tick) {
  return ++tick <= 1000;
}

std::uint32_t random_number() {
  return 4;
}

bool receive(striker::can::Frame&) {
  return false;
}

bool send(const striker::can::Frame&) {
  return true;
}

}  // namespace own_port
