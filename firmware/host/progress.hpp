// SPDX-License-Identifier: Apache-2.0
// The progress of long work on stderr: one line that updates itself on a terminal, a plain line every few
// seconds elsewhere. Wall-clock time is seen here only, never in a result.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace striker::host {

class ProgressLine {
 public:
  // "unit 12/5000  400 unit/s  12 s left  detail". Work that was done before it began counts for no rate. Work that
  // ends within `quiet` shows nothing.
  ProgressLine(std::string unit, std::int64_t total, std::int64_t done_before = 0,
               std::chrono::milliseconds quiet = {});

  // Is it time for another line? Ask before making up a costly detail.
  [[nodiscard]] bool due(std::int64_t done) const;
  void show(std::int64_t done, const std::string& detail);
  void finish();  // ends the updating line

 private:
  using Clock = std::chrono::steady_clock;

  std::string unit_;
  std::int64_t total_;
  std::int64_t done_before_;
  bool terminal_;
  std::chrono::milliseconds quiet_;
  bool shown_ = false;
  Clock::time_point start_;
  Clock::time_point next_;
};

}  // namespace striker::host
