// SPDX-License-Identifier: Apache-2.0
// A bit rate whose bit time is a whole number of ns, as all of CiA 102 are: 10, 20, 50, 100, 125, 250, 500,
// 800, 1000 kbit/s.
#pragma once

#include <cstdint>
#include <string>

namespace striker::sil {

inline constexpr std::int64_t greatest_bit_rate = 1'000'000;        // of classic CAN
inline constexpr std::int64_t greatest_data_bit_rate = 10'000'000;  // of CAN FD's second
inline constexpr std::int64_t least_bit_rate = 10'000;

[[nodiscard]] constexpr std::int64_t bit_time_ns(std::int64_t bit_rate) {
  return 1'000'000'000 / bit_rate;
}

// A whole number of bits whose bit time is a whole number of ns, in range.
[[nodiscard]] inline bool is_bit_rate(const std::string& text, std::int64_t greatest) {
  std::int64_t rate = 0;
  for (const char digit : text) {
    rate = digit >= '0' && digit <= '9' && rate < greatest * 10 ? rate * 10 + (digit - '0') : -1;
    if (rate < 0) {
      return false;
    }
  }
  return rate >= least_bit_rate && rate <= greatest && 1'000'000'000 % rate == 0;
}

// What is wrong with a bit rate given on a command line, and the way out; or nothing.
[[nodiscard]] inline std::string bit_rate_problem(const std::string& text) {
  return is_bit_rate(text, greatest_bit_rate)
             ? std::string()
             : "'" + text +
                   "' is no classic CAN bit rate: give 1000000, 800000, 500000, 250000, 125000, "
                   "100000, 50000, 20000 or 10000";
}

[[nodiscard]] inline std::string data_bit_rate_problem(const std::string& text) {
  return is_bit_rate(text, greatest_data_bit_rate)
             ? std::string()
             : "'" + text +
                   "' is no bit rate of CAN FD's data: give 10000000, 8000000, 5000000, 4000000, 2000000, "
                   "1000000 or 500000";
}

}  // namespace striker::sil
