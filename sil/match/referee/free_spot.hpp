// SPDX-License-Identifier: Apache-2.0
// Where a body may be put without being put onto another, or into a wall.
#pragma once

#include <optional>
#include <span>

#include "sil/world/field_specs.hpp"
#include "sil/world/pose.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

// How far a body reaches from its centre at most, whatever its heading.
inline constexpr double robot_reach_m = 0.7072 * robot_side_m;  // half a diagonal
inline constexpr double ball_reach_m = ball_radius_m;

// Whether no centre of `others` is nearer than the clearance.
[[nodiscard]] bool is_free(Vec2 spot, std::span<const Vec2> others, double clearance_m);

// Whether a body of this reach stands clear of side walls, end walls and corner cuts; the goals count as walls.
[[nodiscard]] bool is_clear_of_walls(Vec2 spot, double reach_m);

// The first free spot that is clear of the walls, in steps of 10 mm: the wanted one; else along +x from it until the
// wall; else along +y from it until the wall; else none. Whose frame it is decides where +x leads: the own-team frame
// of the team at whose end the body is put, so that both ends are alike. A body at x = -1.5 passes any ten others along
// +x: each takes at most twice the published clearance of 0.225 m of 5.3 m.
[[nodiscard]] std::optional<Vec2> free_spot(Vec2 wanted, std::span<const Vec2> others, double clearance_m,
                                            double reach_m);

}  // namespace striker::sil
