// SPDX-License-Identifier: Apache-2.0
// What a player program of AI Soccer 2020 is told, as JSON texts: what it needs to know of a match, and its frames
// (wcg_ai_soccer_2020 c619e20, keys and order of values). Different from there:
//
//   time             seconds on the half's clock
//   robots           z is 0; nobody possesses the ball, as there is no kicker to hold it for
//   ball             z is that of its centre; x, y, z and three nulls
//   subimages, codewords    empty
//   reset_reason     2: the player's own team scored, 3: the other one
#pragma once

#include <string>

#include "sil/match/team/team_view.hpp"

namespace striker::sil {

// Sizes, masses and limits are the world's own.
[[nodiscard]] std::string player_info(int half_ms);

// `score_before`: of the frame before, to tell who scored.
[[nodiscard]] std::string player_frame(const TeamView& view, const std::array<int, 2>& score_before);

}  // namespace striker::sil
