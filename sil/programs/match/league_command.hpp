// SPDX-License-Identifier: Apache-2.0
// `striker-sil league`: every two of some teams against each other, many times.
#pragma once

#include <CLI/CLI.hpp>

#include "sil/match/league/league_run.hpp"

namespace striker::sil {

void define(CLI::App& league, LeaguePlan& plan);

// The exit status: 0 all matches were played, 130 interrupted.
int play_league(const LeaguePlan& plan);

}  // namespace striker::sil
