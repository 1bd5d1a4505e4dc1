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

// Whichever layer it is in, and before anything is computed with it.
TEST(LoadedPolicy, ALayerThatCouldOverflowOrIsOutOfRangeIsRefusedForThat) {
  std::ifstream stream(STRIKER_POLICY_HEADER);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string copy = testing::TempDir() + "edited_" + policy::built_in_name + ".hpp";
  const auto complaint = [&copy](const std::string& edited) {
    std::ofstream(copy) << edited;
    try {
      (void)read_policy_header(copy);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("was read");
  };
  std::size_t layers = 0;
  for (std::size_t at = text.find(".biases = {{"); at != std::string::npos;
       at = text.find(".biases = {{", at + 1), ++layers) {
    std::string edited = text;
    const std::size_t first = at + 12;
    edited.replace(first, text.find_first_of(",}", first) - first, "-2147483647");
    EXPECT_NE(complaint(edited).find("a 32-bit sum could overflow"), std::string::npos) << complaint(edited);
    edited = text;
    edited.replace(first, text.find_first_of(",}", first) - first, "9999999999");
    EXPECT_NE(complaint(edited).find("out of its type's range"), std::string::npos) << complaint(edited);
    edited = text;
    const std::size_t shift = text.find(".shift = ", at) + 9;
    edited.replace(shift, text.find(',', shift) - shift, "31");
    EXPECT_NE(complaint(edited).find("is out of range"), std::string::npos) << complaint(edited);
  }
  EXPECT_EQ(layers, built_in.hidden_layers + 1);
}

}  // namespace
}  // namespace striker::sil
