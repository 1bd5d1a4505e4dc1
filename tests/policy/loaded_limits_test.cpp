// SPDX-License-Identifier: Apache-2.0
// Networks at the proof's limit, computed at run time as the compiled kernel computes them, of every number of layers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "firmware/policy/network.hpp"
#include "sil/policy/loaded_policy.hpp"
#include "tests/policy/limit_policy.hpp"
#include "tests/policy/synthetic_policy.hpp"

namespace striker::sil {
namespace {

template <class Layer>
LoadedLayer loaded(const Layer& from) {
  LoadedLayer layer;
  for (const auto& row : from.weights) {
    layer.weights.emplace_back(row.begin(), row.end());
  }
  layer.biases.assign(from.biases.begin(), from.biases.end());
  layer.shift = from.shift;
  return layer;
}

template <const auto& network>
void expect_same_sums() {
  using Shape = policy::ShapeOf<network>;
  LoadedPolicy read;
  read.input_scales.assign(network.input_scales.begin(), network.input_scales.end());
  [&]<std::size_t... n>(std::index_sequence<n...>) {
    (read.layers.push_back(loaded(network.template layer<n>())), ...);
  }
  (std::make_index_sequence<Shape::hidden_layers + 1>{});
  policy::SmallRandom random(3);
  std::array<std::int32_t, Shape::inputs> raw{};
  raw.fill(std::numeric_limits<std::int32_t>::max());
  for (int i = 0; i < 200; ++i) {
    const auto expected = policy::infer<network>(raw);
    const auto sums = sums_of(read, raw);
    ASSERT_TRUE(std::ranges::equal(sums, expected.sums)) << i;
    ASSERT_EQ(choice_of(sums), expected.action) << i;
    std::ranges::generate(raw, [&] { return policy::draw_raw(random); });
  }
}

TEST(LoadedPolicy, AtTheProofsLimitItGivesTheCompiledOnesSums) {
  expect_same_sums<policy::limit_narrow>();
  expect_same_sums<policy::limit_one>();
  expect_same_sums<policy::limit_two>();
  expect_same_sums<policy::limit_three>();
  expect_same_sums<policy::limit_widest>();
  expect_same_sums<policy::limit_int8_three>();
}

}  // namespace
}  // namespace striker::sil
