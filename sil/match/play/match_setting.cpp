// SPDX-License-Identifier: Apache-2.0
#include "sil/match/play/match_setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "firmware/loop/built_in_node.hpp"
#include "sil/match/team/strategies.hpp"
#include "sil/world/random_streams.hpp"

namespace striker::sil {

namespace {

std::string identity_of(const std::string& team) {
  const auto names = strategy_names();
  const auto found = std::ranges::find(names, team, &StrategyName::name);
  return found != names.end() && found->orders_motions ? fmt::format("{:08x}", loop::BuiltInPilot::identity)
                                                       : std::string();
}

}  // namespace

std::array<std::string, 2> identities_of(const std::array<std::string, 2>& names) {
  return {identity_of(names[0]), identity_of(names[1])};
}

MatchPlan plan_of(const MatchSetting& setting) {
  constexpr double rad_a_deg = std::numbers::pi / 180.0;
  MatchPlan plan;
  plan.plant = plant_kind_of(setting.plant).value();
  plan.header = {.teams = setting.teams,
                 .seed = setting.seed,
                 .rules = setting.rules == "published" ? published() : official(),
                 .rule_set = setting.rules,
                 .plant = setting.plant,
                 .slip = setting.slip,
                 .jitter_m = setting.jitter_mm / 1e3,
                 .jitter_rad = setting.jitter_mm / 10.0 * rad_a_deg,
                 .faults = {},
                 .identities = identities_of(setting.teams)};
  plan.header.rules.half_ms = setting.half_s * 1000;
  return plan;
}

std::uint64_t team_seed(const MatchSetting& setting, Team team) {
  return Random(setting.seed, index_of(team), random_stream::match_team).next();
}

}  // namespace striker::sil
