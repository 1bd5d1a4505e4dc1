// SPDX-License-Identifier: Apache-2.0
// Teams to be measured against that do not look at the match: AI World Cup's skeleton and random walk (examples
// ae937e6).
#pragma once

#include <cstdint>

#include "sil/match/team/strategy.hpp"
#include "sil/world/random.hpp"

namespace striker::sil {

// Stands.
class IdleTeam final : public Strategy {
 public:
  [[nodiscard]] TeamOrders play(const TeamView& view) override;
};

// Each wheel anything within its limits, each frame anew.
class RandomTeam final : public Strategy {
 public:
  explicit RandomTeam(std::uint64_t seed);
  [[nodiscard]] TeamOrders play(const TeamView& view) override;

 private:
  Random random_;
};

}  // namespace striker::sil
