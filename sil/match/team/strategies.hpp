// SPDX-License-Identifier: Apache-2.0
// The teams of this project, by name. A player program of somebody else is not among them: tcp/tcp_strategy.hpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "sil/match/team/strategy.hpp"

namespace striker::sil {

struct StrategyName {
  std::string_view name;
  std::string_view help;        // a line, without a full stop
  bool orders_motions = false;  // it plays with what the forwards' policy has learned
};

[[nodiscard]] std::span<const StrategyName> strategy_names();

// Teams that draw nothing ignore the seed. Two random teams with the same seed do the same. Throws
// std::invalid_argument, with the names that exist, if this is none of them.
[[nodiscard]] std::unique_ptr<Strategy> make_strategy(std::string_view name, std::uint64_t seed);

}  // namespace striker::sil
