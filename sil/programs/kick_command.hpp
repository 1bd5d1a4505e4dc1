// SPDX-License-Identifier: Apache-2.0
// `striker-sil kick`: the run, its files and its endings.
#pragma once

#include "sil/programs/kick_options.hpp"

namespace striker::sil {

// Of a run that ended otherwise than with all its episodes driven by a controller: each keeps what was finished.
inline constexpr int exit_not_driven = 3;
inline constexpr int exit_emergency_stop = 4;
inline constexpr int exit_broken_off = 5;  // the bus or a file failed after the first episode

// The exit status: 0, one of these, or 130 interrupted.
int play_kicks(const KickOptions& options);

}  // namespace striker::sil
