// SPDX-License-Identifier: Apache-2.0
// How players of AI Soccer drive: the published go-to, turn-to and wheel limiters (AI World Cup examples ae937e6,
// player_rulebased-A_py, "v0.7"; the second limiter: wcg_ai_soccer_2020 c619e20). Facts and formulas only.
//
// The go-to does not stop: at its target it is as fast as 0.35 of speed * reach (a "damping" of the published one),
// drives on, turns round and comes back. Told places or speeds that are no finite numbers, all of them say: stand.
#pragma once

#include "sil/match/team/order.hpp"

namespace striker::sil {

// The published parameters in their order. "Full" scales both wheels up until the faster one is at its top speed.
struct GoToGains {
  double speed = 1.4;  // s: of all
  double reach = 3.5;  // m: of the way ahead
  double turn = 0.4;   // g: of the error of heading
  bool full = false;

  bool operator==(const GoToGains&) const = default;
};

// Behind a robot is what is more than 95 degrees off: it drives there backwards. The published go-to then turns its
// tail away from the target until it is so far off that it spins; corrected, the tail turns to it.
enum class ReverseSteering { published, corrected };

// Both wheels scaled alike if one of them is beyond the top speed, or if `full`. The way's curvature is kept.
[[nodiscard]] SpeedOrder limited_in_ratio(SpeedOrder wheels, double top_m_s, bool full = false);

// Both wheels moved alike until none is beyond the top speed. The turn is kept, at the cost of speed. (A turn beyond
// twice the top speed does not fit: one wheel is then still too fast, and is cut by itself.)
[[nodiscard]] SpeedOrder limited_in_difference(SpeedOrder wheels, double top_m_s);

// Not yet limited.
[[nodiscard]] SpeedOrder wheels_to(const Pose& robot, Vec2 target_m, const GoToGains& gains,
                                   ReverseSteering reverse);

[[nodiscard]] SpeedOrder go_to(const Pose& robot, Vec2 target_m, const GoToGains& gains, double top_m_s,
                               ReverseSteering reverse);

// Turns on the spot until front or back is in this direction.
[[nodiscard]] SpeedOrder turn_to(const Pose& robot, double heading_rad, double top_m_s);

}  // namespace striker::sil
