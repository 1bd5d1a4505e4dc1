// SPDX-License-Identifier: Apache-2.0
// How far a run is, on stderr.
#pragma once

#include <cstdint>

#include "firmware/host/progress.hpp"
#include "sil/record/observer.hpp"

namespace striker::sil {

class EpisodeProgress final : public Observer {
 public:
  explicit EpisodeProgress(std::uint64_t episodes) : line_("episode", static_cast<std::int64_t>(episodes)) {}

  void end_episode() override {
    ++done_;
    if (line_.due(done_)) {
      line_.show(done_, "");
    }
  }
  void end_run() override { line_.finish(); }

 private:
  host::ProgressLine line_;
  std::int64_t done_ = 0;
};

}  // namespace striker::sil
