// SPDX-License-Identifier: Apache-2.0
// What goes wrong in a match: a plan of faults (sil/fault/README.md) whose cases are named robot0 to robot9, each with the
// faults of that robot, and of nobody else. `from_ms` and `from_tick` both count from the match's first tick; what else a case may set up is
// the match's own.
//
//   [[case]]
//   name = "robot3"
//   [[case.fault]]
//   kind = "loss"
//   probability = 0.1
//   from_ms = 0
//   until_ms = 600000
#pragma once

#include <string>
#include <string_view>

#include "sil/match/play/match_run.hpp"

namespace striker::sil {

// Puts the plan and its text into the match. Throws std::runtime_error with one line that names file, field and what it
// may be.
void add_faults(MatchPlan& plan, std::string_view text, const std::string& file);

}  // namespace striker::sil
