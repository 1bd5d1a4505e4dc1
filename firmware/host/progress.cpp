// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace striker::host {

namespace {

using namespace std::chrono_literals;

constexpr auto terminal_period = 200ms;
constexpr auto plain_period = 5s;

}  // namespace

ProgressLine::ProgressLine(std::string unit, std::int64_t total, std::int64_t done_before,
                           std::chrono::milliseconds quiet)
    : unit_(std::move(unit)),
      total_(total),
      done_before_(done_before),
      terminal_(isatty(STDERR_FILENO) == 1),
      quiet_(quiet),
      start_(Clock::now()),
      next_(start_ + quiet) {}

bool ProgressLine::due(std::int64_t done) const {
  const bool last = done >= total_ && (shown_ || quiet_ == 0ms);
  return last || Clock::now() >= next_;
}

void ProgressLine::show(std::int64_t done, const std::string& detail) {
  const auto now = Clock::now();
  next_ = now + (terminal_ ? Clock::duration(terminal_period) : Clock::duration(plain_period));
  const double elapsed_s = std::max(1e-3, std::chrono::duration<double>(now - start_).count());
  const double rate = static_cast<double>(done - done_before_) / elapsed_s;
  const double left_s = rate > 0.0 ? static_cast<double>(total_ - done) / rate : 0.0;
  const std::string line = fmt::format("{} {}/{}  {:.{}f} {}s/s  {:.0f} s left  {}", unit_, done, total_,
                                       rate, rate < 10.0 ? 2 : 0, unit_, left_s, detail);
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r" : "", line, terminal_ ? "\x1b[K" : "\n");
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::finish() {
  if (terminal_ && shown_) {
    fmt::print(stderr, "\n");
  }
}

}  // namespace striker::host
