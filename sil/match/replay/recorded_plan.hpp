// SPDX-License-Identifier: Apache-2.0
// What a recorded match was played by, read from its match.json (sil/match/record/match_report.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "sil/match/play/match_run.hpp"

namespace striker::sil {

struct RecordedMatch {
  MatchPlan plan;
  MatchEnd end;
  std::int64_t frames = 0;  // of 50 ms that were played
};

// Throws std::runtime_error that names the file, and the key that is missing or has no meaning.
[[nodiscard]] RecordedMatch read_match(const std::filesystem::path& match_json);

// What says with which build a match was played.
inline constexpr std::array<std::string_view, 3> keys_of_build = {"version", "git_hash", "build_type"};

// The first value of a recorded match.json that the match played again does not give: "/red/goals is 3, now 2". The
// keys of its build do not count.
[[nodiscard]] std::optional<std::string> first_other_value(const std::filesystem::path& match_json,
                                                           const nlohmann::ordered_json& now);

}  // namespace striker::sil
