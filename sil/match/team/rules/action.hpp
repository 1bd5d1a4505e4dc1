// SPDX-License-Identifier: Apache-2.0
// What a table of the rule-based players says that a robot does in this frame.
#pragma once

#include <variant>

#include "sil/match/team/go_to.hpp"

namespace striker::sil {

struct GoTo {
  Vec2 target_m;
  GoToGains gains;

  bool operator==(const GoTo&) const = default;
};

struct TurnTo {
  double heading_rad = 0.0;

  bool operator==(const TurnTo&) const = default;
};

struct Stand {
  bool operator==(const Stand&) const = default;
};

using Action = std::variant<GoTo, TurnTo, Stand>;

[[nodiscard]] SpeedOrder wheels_of(const Action& action, const Pose& robot, double top_m_s,
                                   ReverseSteering reverse);

}  // namespace striker::sil
