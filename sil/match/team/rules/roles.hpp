// SPDX-License-Identifier: Apache-2.0
// The tables of the rule-based players: goalkeeper (0), defenders (1, 2), forwards (3, 4), in open play and corner
// kicks. The first condition that holds decides. Source: AI World Cup examples ae937e6, player_rulebased-B_py.
#pragma once

#include <cstddef>

#include "sil/match/team/rules/action.hpp"
#include "sil/match/team/rules/sight.hpp"

namespace striker::sil {

[[nodiscard]] Action goalkeeper_action(const Pose& robot, Vec2 ball);
[[nodiscard]] Action defender_action(Vec2 robot, Vec2 ball, bool is_nearest);
[[nodiscard]] Action forward_action(const Sight& sight, std::size_t id, bool is_nearest);

// By id.
[[nodiscard]] Action role_action(const Sight& sight, std::size_t id);

}  // namespace striker::sil
