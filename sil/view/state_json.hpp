// SPDX-License-Identifier: Apache-2.0
// What the live page is told, as JSON; web/striker_view.js is who reads it. Places in mm, angles in degrees, speeds in mm/s,
// torques in mNm, times in ms unless a key says _us.
#pragma once

#include <string>
#include <vector>

#include "sil/view/live_state.hpp"

namespace striker::sil {

struct ViewFacts {
  std::string scenario;             // "kick" or "match"
  std::vector<std::string> teams;   // red's and blue's, of a match
  std::vector<std::string> faults;  // kinds that can begin on this bus
  bool has_time = true;             // may be paused, stepped and made faster
};

// {"hello": ...}: what does not change: the facts, the message table, the policy's actions, the bus.
[[nodiscard]] std::string hello_text(const ViewFacts& facts);

// {"state": ...}. Computes the network's Q values of each robot whose inputs are known: some 10 us each.
[[nodiscard]] std::string state_text(const LiveState& state);

// {"ended": ...}: why the run ended; the last that is said.
[[nodiscard]] std::string ended_text(const std::string& why);

}  // namespace striker::sil
