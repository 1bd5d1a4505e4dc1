// SPDX-License-Identifier: Apache-2.0
// What the command lines of a match and of a league have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "sil/match/play/match_setting.hpp"

namespace striker::sil {

// Of a team's name: what is wrong with it, and the way out. A player program, tcp:PORT, is a team of a match alone.
[[nodiscard]] std::string strategy_problem(const std::string& name);
[[nodiscard]] std::string team_problem(const std::string& name);

// Seed, halves, motors, rules, slip and jitter. `setting` outlives the parsing.
void define_play(CLI::App& command, MatchSetting& setting);

}  // namespace striker::sil
