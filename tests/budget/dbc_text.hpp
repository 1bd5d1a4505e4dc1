// SPDX-License-Identifier: Apache-2.0
// DBC texts for tests: what is read of them, and how they are refused.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "sil/budget/dbc_reader.hpp"

namespace striker::sil {

inline std::vector<BusMessage> read(const std::string& text, const DbcOptions& options = {}) {
  return read_dbc(text, "a.dbc", options);
}

// Without the file's name.
inline std::string refusal(const std::string& text, const DbcOptions& options = {}) {
  try {
    EXPECT_FALSE(read(text, options).empty());
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind("a.dbc: ", 0), 0U) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what.substr(7);
  }
  return "";
}

inline auto parts(const BusMessage& message) {
  return std::tie(message.name, message.sender, message.id, message.bytes, message.period_ns,
                  message.distance_ns, message.burst, message.deadline_ns, message.format.extended,
                  message.format.fd, message.format.bit_rate_switch, message.events_uncounted);
}

inline void expect_same(const std::vector<BusMessage>& one, const std::vector<BusMessage>& other,
                        const std::string& text) {
  ASSERT_EQ(one.size(), other.size()) << text;
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(parts(one[i]), parts(other[i])) << text;
  }
}

}  // namespace striker::sil
