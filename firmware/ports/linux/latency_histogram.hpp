// SPDX-License-Identifier: Apache-2.0
// Times counted in fixed bins, without allocation: 1 us wide up to 1 ms, then eight to a doubling up to
// 17 minutes; what is longer counts in the last. Least, greatest and sum are exact.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace striker::linux_port {

class LatencyHistogram {
 public:
  static constexpr std::size_t bins = 1000 + 20 * 8;

  // A negative time counts as 0. `tick` is when it was measured, for the greatest.
  void add(std::int64_t time_ns, std::uint32_t tick) {
    const std::int64_t ns = time_ns < 0 ? 0 : time_ns;
    ++counts_[bin_of(ns / 1000)];
    ++count_;
    sum_ns_ += ns;
    min_ns_ = ns < min_ns_ ? ns : min_ns_;
    if (ns > max_ns_ || count_ == 1) {
      max_ns_ = ns;
      max_tick_ = tick;
    }
  }

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::uint64_t count_in(std::size_t bin) const { return counts_[bin]; }
  [[nodiscard]] std::int64_t min_ns() const { return count_ == 0 ? 0 : min_ns_; }
  [[nodiscard]] std::int64_t max_ns() const { return max_ns_; }
  [[nodiscard]] std::uint32_t max_tick() const { return max_tick_; }
  [[nodiscard]] double mean_ns() const {
    return count_ == 0 ? 0.0 : static_cast<double>(sum_ns_) / static_cast<double>(count_);
  }

  // The lower end, in us, of the bin that holds the smallest time with at least this share of all at or below
  // it; 0 without times.
  [[nodiscard]] std::int64_t percentile_us(double share) const {
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < bins; ++bin) {
      below += counts_[bin];
      if (below != 0 && static_cast<double>(below) >= share * static_cast<double>(count_)) {
        return lower_end_us(bin);
      }
    }
    return 0;
  }

  // A bin goes from its lower end to the next one's.
  [[nodiscard]] static constexpr std::int64_t lower_end_us(std::size_t bin) {
    if (bin < 1000) {
      return static_cast<std::int64_t>(bin);
    }
    const std::size_t octave = (bin - 1000) / 8;
    const auto eighths = static_cast<std::int64_t>(8 + (bin - 1000) % 8);
    return (eighths * (std::int64_t{1000} << octave)) / 8;
  }

  [[nodiscard]] static constexpr std::size_t bin_of(std::int64_t us) {
    if (us < 1000) {
      return static_cast<std::size_t>(us);
    }
    const auto octave = static_cast<std::size_t>(std::bit_width(static_cast<std::uint64_t>(us / 1000)) - 1);
    if (octave >= 20) {
      return bins - 1;
    }
    const auto eighths = static_cast<std::size_t>(us * 8 / (std::int64_t{1000} << octave));
    return 1000 + octave * 8 + (eighths - 8);
  }

 private:
  std::array<std::uint64_t, bins> counts_{};
  std::uint64_t count_ = 0;
  std::int64_t sum_ns_ = 0;
  std::int64_t min_ns_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t max_ns_ = 0;
  std::uint32_t max_tick_ = 0;
};

}  // namespace striker::linux_port
