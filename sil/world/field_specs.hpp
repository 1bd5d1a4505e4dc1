// SPDX-License-Identifier: Apache-2.0
// Size of the AI Soccer field and ball.
#pragma once

namespace striker::sil {

inline constexpr double field_half_length_m = 3.9;
inline constexpr double field_half_width_m = 2.325;
inline constexpr double goal_back_m = 4.35;  // |x| of the back plane
inline constexpr double goal_half_width_m = 0.5;
inline constexpr double corner_leg_m = 0.1;  // the corners are cut at 45 degrees
inline constexpr double robot_ceiling_m = 0.2;
inline constexpr double ball_ceiling_m = 0.8;

// The radius that is simulated; players of AI Soccer are told 0.04.
inline constexpr double ball_radius_m = 0.05;
inline constexpr double ball_mass_kg = 0.0184;

}  // namespace striker::sil
