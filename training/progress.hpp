// The progress of a long training on stderr: one line that updates itself on a terminal, a plain line every
// few seconds elsewhere. Wall-clock time is seen here only, never in a result.
#pragma once

#include <chrono>
#include <string>

#include "dqn.hpp"

namespace striker::training {

class ProgressLine {
 public:
  explicit ProgressLine(int episodes);
  void show(const EpisodeRow& row);
  void finish();  // ends the updating line

 private:
  using Clock = std::chrono::steady_clock;

  int episodes_;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point start_;
  Clock::time_point next_;
};

}  // namespace striker::training
