// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/rules/action.hpp"

namespace striker::sil {

SpeedOrder wheels_of(const Action& action, const Pose& robot, double top_m_s, ReverseSteering reverse) {
  if (const auto* way = std::get_if<GoTo>(&action)) {
    return go_to(robot, way->target_m, way->gains, top_m_s, reverse);
  }
  if (const auto* turn = std::get_if<TurnTo>(&action)) {
    return turn_to(robot, turn->heading_rad, top_m_s);
  }
  return {};
}

}  // namespace striker::sil
