// SPDX-License-Identifier: Apache-2.0
// What the proof lets through at its very limit is computed exactly, in every layer of one, two and three hidden
// layers; what is one beyond it is refused, wherever it is.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "firmware/policy/kernel/int16/portable.hpp"
#include "firmware/policy/proof.hpp"
#include "tests/policy/limit_policy.hpp"
#include "tests/policy/tested_infer.hpp"

namespace striker::policy {
namespace {

using Limits = std::numeric_limits<std::int32_t>;

template <const auto& policy>
void expect_exact() {
  static_assert(scales_are_valid(policy) && sums_fit(policy));
  std::array<std::int32_t, ShapeOf<policy>::inputs> raw{};
  raw.fill(Limits::max());
  const auto q = tested_infer<policy>(raw);
  for (std::size_t k = 0; k < q.sums.size(); ++k) {
    EXPECT_EQ(q.sums[k], k % 2 == 0 ? Limits::max() : -Limits::max()) << k;
  }
  EXPECT_EQ(q.action, 0);
  // From there down to the other end, one input after another.
  for (std::int32_t& element : raw) {
    element = Limits::min();
    EXPECT_EQ(tested_infer<policy>(raw).sums, (infer<policy, kernel::int16::Portable>(raw).sums));
  }
}

TEST(ProofLimits, SumsAtTheLimitAreExactInEveryLayer) {
#ifdef __AVX2__
  if (!__builtin_cpu_supports("avx2")) {
    GTEST_SKIP() << "this processor has no AVX2";
  }
#endif
  expect_exact<limit_narrow>();
  expect_exact<limit_one>();
  expect_exact<limit_two>();
  expect_exact<limit_three>();
  expect_exact<limit_widest>();
  expect_exact<limit_int8_one>();
  expect_exact<limit_int8_three>();
}

// One more in the bias of any layer's first and last neuron, whatever its sign.
template <std::size_t n, class Shape>
void expect_refusal_of_one_more(const Shape& policy) {
  const auto sound_after = [&policy](std::size_t neuron) {
    Shape copy = policy;
    auto& bias = const_cast<std::int32_t&>(copy.template layer<n>().biases[neuron]);
    bias += bias < 0 ? -1 : 1;
    return sums_fit(copy);
  };
  EXPECT_FALSE(sound_after(0)) << "layer " << n;
  EXPECT_FALSE(sound_after(policy.template layer<n>().biases.size() - 1)) << "layer " << n;
}

template <const auto& policy>
void expect_refusals() {
  [&]<std::size_t... n>(std::index_sequence<n...>) {
    (expect_refusal_of_one_more<n>(policy), ...);
  }
  (std::make_index_sequence<ShapeOf<policy>::hidden_layers + 1>{});
}

TEST(ProofLimits, OneMoreInAnyLayerIsRefused) {
  expect_refusals<limit_narrow>();
  expect_refusals<limit_one>();
  expect_refusals<limit_two>();
  expect_refusals<limit_three>();
  expect_refusals<limit_widest>();
  expect_refusals<limit_int8_one>();
  expect_refusals<limit_int8_three>();
}

// A layer that stores less than it could leaves the next one room for more.
TEST(ProofLimits, TheNextLayersLimitIsCountedFromWhatALayerCanStore) {
  auto halved = limit_three;
  halved.layer2.shift = 17;
  halved.layer2.biases[0] -= 1 << 15;  // the greater rounding
  ASSERT_TRUE(sums_fit(halved));
  const auto less = static_cast<std::int64_t>(halved.layer3.weights[0][0]) * (32767 - 16383);
  halved.layer3.biases[0] += static_cast<std::int32_t>(less);
  EXPECT_TRUE(sums_fit(halved));
  ++halved.layer3.biases[0];
  EXPECT_FALSE(sums_fit(halved));
}

TEST(ProofLimits, AShiftBeyondItsRangeIsRefusedInEveryLayer) {
  for (const int shift : {0, 31, 255}) {
    auto first = limit_three, second = limit_three, third = limit_three, output = limit_three;
    first.layer1.shift = second.layer2.shift = third.layer3.shift = static_cast<std::uint8_t>(shift);
    output.output.shift = static_cast<std::uint8_t>(shift);
    EXPECT_FALSE(scales_are_valid(first) || scales_are_valid(second) || scales_are_valid(third));
    EXPECT_EQ(scales_are_valid(output), shift == 0);
  }
}

}  // namespace
}  // namespace striker::policy
