// SPDX-License-Identifier: Apache-2.0
// What striker-ceiling prints and writes: a table for people, JSON, and a row an episode.
#pragma once

#include <string>
#include <vector>

#include "training/ceiling/ceiling_run.hpp"

namespace striker::training {

[[nodiscard]] std::string ceiling_table(const CeilingOptions& options,
                                        const std::vector<CeilingEpisode>& episodes);
[[nodiscard]] std::string ceiling_json(const CeilingOptions& options,
                                       const std::vector<CeilingEpisode>& episodes);
// A row an episode, with the found actions as letters: forward, stop, backward.
[[nodiscard]] std::string ceiling_csv(const CeilingOptions& options,
                                      const std::vector<CeilingEpisode>& episodes);

}  // namespace striker::training
