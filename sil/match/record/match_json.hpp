// SPDX-License-Identifier: Apache-2.0
// What several records of a match say alike, as JSON with a fixed order of keys.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "sil/match/record/match_frame.hpp"

namespace striker::sil {

// The match as it was set up, in this order:
//   teams, identities  each [red's, blue's], by name; identity null: the team has none
//   seed, plant, slip, jitter_m, jitter_rad
//   rule_set           by name
//   rules              every limit and switch of MatchRules, by its name there
//   geometry           of field, ball and robots, in m
//   physics            constants of the world: of ball and floor
[[nodiscard]] nlohmann::ordered_json header_json(const MatchHeader& header);

[[nodiscard]] nlohmann::ordered_json rules_json(const MatchRules& rules);

// [x, y], [x, y, heading]; null if there is none.
[[nodiscard]] nlohmann::ordered_json json_of(Vec2 spot);
[[nodiscard]] nlohmann::ordered_json json_of(const Pose& pose);

template <class T>
[[nodiscard]] nlohmann::ordered_json json_of(const std::optional<T>& value) {
  return value ? json_of(*value) : nlohmann::ordered_json();
}

// "red" or "blue".
[[nodiscard]] constexpr std::string_view name_of(Team team) {
  return team == Team::red ? "red" : "blue";
}

}  // namespace striker::sil
