// SPDX-License-Identifier: Apache-2.0
// Which of AI Soccer's three robots a player of a team is.
#pragma once

#include <cstddef>

#include "firmware/core/robot_profile.hpp"
#include "sil/match/referee/referee_frame.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

struct RobotKind {
  Role role;
  const core::RobotDescription* description;
};

// Of a robot of the match, 0 to 9.
[[nodiscard]] inline RobotKind kind_of(std::size_t robot) {
  const std::size_t id = id_of(robot);
  if (id == goalkeeper_id) {
    return {Role::goalkeeper, &core::goalkeeper};
  }
  return id <= 2 ? RobotKind{Role::defender, &core::defender} : RobotKind{Role::forward, &core::forward};
}

}  // namespace striker::sil
