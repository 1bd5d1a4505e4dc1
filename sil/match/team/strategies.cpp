// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/strategies.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string>

#include "sil/match/team/rules/rules_team.hpp"
#include "sil/match/team/simple_teams.hpp"
#include "sil/match/team/striker/striker_team.hpp"

namespace striker::sil {

namespace {

using Make = std::unique_ptr<Strategy> (*)(std::uint64_t seed);

template <ReverseSteering reverse, bool passing>
std::unique_ptr<Strategy> rules_team(std::uint64_t /*seed*/) {
  return std::make_unique<RulesTeam>(RulesOptions{.reverse = reverse, .passing = passing});
}

template <bool kicks>
std::unique_ptr<Strategy> striker_team(std::uint64_t /*seed*/) {
  return std::make_unique<StrikerTeam>(StrikerOptions{.kicks = kicks});
}

struct Entry {
  StrategyName name;
  Make make;
};

const std::array entries = {
    Entry{{"idle", "stands"},
          [](std::uint64_t) -> std::unique_ptr<Strategy> { return std::make_unique<IdleTeam>(); }},
    Entry{{"random", "each wheel anything, each frame anew"},
          [](std::uint64_t seed) -> std::unique_ptr<Strategy> { return std::make_unique<RandomTeam>(seed); }},
    Entry{{"rules", "AI Soccer's rule-based player B, steering the right way in reverse"},
          rules_team<ReverseSteering::corrected, false>},
    Entry{{"rules-published", "the same to the letter: in reverse it steers the wrong way"},
          rules_team<ReverseSteering::published, false>},
    Entry{{"rules-passing", "AI Soccer's rule-based player A: as rules, and it tries to pass"},
          rules_team<ReverseSteering::corrected, true>},
    Entry{{"striker", "this project's: prediction, one chaser, spots, and the learned kick where it pays",
           true},
          striker_team<true>},
    Entry{{"striker-driving", "the same without the learned kick"}, striker_team<false>},
};

}  // namespace

std::span<const StrategyName> strategy_names() {
  static const auto names = [] {
    std::array<StrategyName, entries.size()> result;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      result[i] = entries[i].name;
    }
    return result;
  }();
  return names;
}

std::unique_ptr<Strategy> make_strategy(std::string_view name, std::uint64_t seed) {
  std::string known;
  for (const Entry& entry : entries) {
    if (entry.name.name == name) {
      return entry.make(seed);
    }
    known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.name.name);
  }
  throw std::invalid_argument(fmt::format("there is no team \"{}\"; there are: {}", name, known));
}

}  // namespace striker::sil
