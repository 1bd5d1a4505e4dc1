// SPDX-License-Identifier: Apache-2.0
// How fast a robot of a team can drive, by its id.
#pragma once

#include <cstddef>

#include "sil/match/referee/referee_frame.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

[[nodiscard]] constexpr Role role_of(std::size_t id) {
  if (id == goalkeeper_id) {
    return Role::goalkeeper;
  }
  return id <= 2 ? Role::defender : Role::forward;
}

// Of each wheel's rim: 1.8, 2.1 or 2.55 m/s.
[[nodiscard]] constexpr double top_speed_m_s(std::size_t id) {
  return robot_spec(role_of(id)).max_rim_speed_m_s;
}

}  // namespace striker::sil
