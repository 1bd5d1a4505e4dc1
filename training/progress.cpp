#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace striker::training {

namespace {

using namespace std::chrono_literals;

constexpr auto terminal_period = 200ms;
constexpr auto plain_period = 5s;

}  // namespace

ProgressLine::ProgressLine(int episodes)
    : episodes_(episodes), terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()), next_(start_) {}

void ProgressLine::show(const EpisodeRow& row) {
  const auto now = Clock::now();
  const int done = row.episode + 1;
  if (now < next_ && done < episodes_) {
    return;
  }
  next_ = now + (terminal_ ? Clock::duration(terminal_period) : Clock::duration(plain_period));
  const double elapsed_s = std::max(1e-3, std::chrono::duration<double>(now - start_).count());
  const double rate = done / elapsed_s;
  const double left_s = (episodes_ - done) / rate;
  const std::string line =
      fmt::format("episode {}/{}  {:.0f} episodes/s  {:.0f} s left  reward {:.2f} (mean of {})", done,
                  episodes_, rate, left_s, row.moving_average, std::min(done, moving_average_span));
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r" : "", line, terminal_ ? "\x1b[K" : "\n");
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::finish() {
  if (terminal_ && shown_) {
    fmt::print(stderr, "\n");
  }
}

}  // namespace striker::training
