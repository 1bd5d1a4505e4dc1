// SPDX-License-Identifier: Apache-2.0
// A header that is read at run time against the same header compiled: the same numbers for whatever is asked.
#include "sil/policy/loaded_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>

#include "firmware/policy/built_in.hpp"
#include "firmware/policy/network.hpp"

namespace striker::sil {
namespace {

using policy::built_in;
using Raw = std::array<std::int32_t, policy::ShapeOf<built_in>::inputs>;

TEST(LoadedPolicy, GivesTheCompiledOnesSumsAndActionForEveryInput) {
  const LoadedPolicy loaded = read_policy_header(STRIKER_POLICY_HEADER);
  EXPECT_EQ(loaded.identity, built_in.identity);
  EXPECT_EQ(loaded.name, policy::built_in_name);
  std::mt19937 random(1);
  for (const std::int32_t greatest : {100, 3000, 70'000, 3'000'000, 2'147'483'647}) {
    std::uniform_int_distribution<std::int32_t> value(-greatest, greatest);
    for (int i = 0; i < 1000; ++i) {
      Raw raw;
      std::ranges::generate(raw, [&] { return value(random); });
      const auto expected = policy::infer<built_in>(raw);
      const auto sums = sums_of(loaded, raw);
      ASSERT_TRUE(std::ranges::equal(sums, expected.sums));
      ASSERT_EQ(choice_of(sums), expected.action);
    }
  }
}

// Any digit of it: the reader knows every number, and the identity holds all of them.
TEST(LoadedPolicy, AnAlteredNumberIsRefused) {
  std::ifstream stream(STRIKER_POLICY_HEADER);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string copy = testing::TempDir() + "altered_" + policy::built_in_name + ".hpp";
  const std::size_t begin = text.find(".identity");
  std::mt19937 random(2);
  for (int i = 0; i < 30; ++i) {
    std::size_t at = 0;
    do {
      at = begin + random() % (text.size() - begin);
    } while (text[at] < '1' || text[at] > '8' || text.find("\n};") < at || text.rfind("layer", at) + 6 > at);
    std::string altered = text;
    ++altered[at];
    std::ofstream(copy) << altered;
    EXPECT_THROW((void)read_policy_header(copy), std::runtime_error) << "at byte " << at;
  }
  std::ofstream(copy) << text;
  EXPECT_NO_THROW((void)read_policy_header(copy));
  for (const std::size_t length : {std::size_t{0}, begin, text.size() / 2, text.size() - 60}) {
    std::ofstream(copy) << text.substr(0, length);
    EXPECT_THROW((void)read_policy_header(copy), std::runtime_error) << "the first " << length << " bytes";
  }
}

}  // namespace
}  // namespace striker::sil
