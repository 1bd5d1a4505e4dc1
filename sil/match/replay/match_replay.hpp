// SPDX-License-Identifier: Apache-2.0
// A match again from its bus logs: the world, the referee and the ten controllers play anew what the teams ordered, and
// every frame on every bus is compared with the recorded one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "sil/match/play/match_links.hpp"
#include "sil/match/play/match_run.hpp"

namespace striker::sil {

// The first frame that is another. An empty text: there is none.
struct ReplayDifference {
  std::uint32_t tick = 0;
  std::size_t robot = 0;
  std::string recorded;  // as in the log
  std::string now;
};

struct MatchReplay {
  std::optional<ReplayDifference> difference;
  std::uint64_t frames = 0;  // that were compared and are the same
  MatchEnd end;
};

// `buses` is the directory of the logs; `frames` says how many of 50 ms were played: a match that was interrupted is
// played as far. `records` see the match as it comes out. Throws std::runtime_error that names a log which cannot be
// read.
[[nodiscard]] MatchReplay replay_match(const MatchPlan& plan, std::int64_t frames,
                                       const std::filesystem::path& buses, const MatchLinks& links,
                                       std::span<MatchObserver* const> records,
                                       const std::function<bool()>& stop);

}  // namespace striker::sil
