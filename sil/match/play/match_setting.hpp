// SPDX-License-Identifier: Apache-2.0
// A match as a person asks for it, in a few plain values; what is left out has AI Soccer's own.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "sil/match/play/match_run.hpp"

namespace striker::sil {

struct MatchSetting {
  std::array<std::string, 2> teams = {"rules", "rules"};  // red's and blue's strategy
  std::uint64_t seed = 1;
  int half_s = 300;
  std::string rules = "official";  // or "published"
  std::string plant = "servo";     // or "drive"
  double slip = 0.0;
  double jitter_mm = 10.0;  // of every formation; headings by as many tenths of a degree
};

[[nodiscard]] MatchPlan plan_of(const MatchSetting& setting);

// What teams of these names play with in this build (MatchHeader::identities).
[[nodiscard]] std::array<std::string, 2> identities_of(const std::array<std::string, 2>& names);

// For a strategy that draws: another one for each colour.
[[nodiscard]] std::uint64_t team_seed(const MatchSetting& setting, Team team);

}  // namespace striker::sil
