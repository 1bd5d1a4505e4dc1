// SPDX-License-Identifier: Apache-2.0
// The kernel against a plain 64-bit reference written from the specification in policy.hpp, on the built-in
// policy: random, saturating and adversarial inputs, and the header's golden vectors.
#include "firmware/policy/network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "firmware/policy/built_in.hpp"
#include "firmware/policy/exported/aimed.hpp"
#include "firmware/policy/exported/kick_dqn.hpp"
#include "firmware/policy/proof.hpp"
#include "tests/policy/tested_infer.hpp"

namespace striker::policy {
namespace {

using Raw = std::array<std::int32_t, built_in.inputs>;

template <std::size_t Inputs, std::size_t Outputs, class Weight>
std::vector<std::int64_t> sums_of(const Layer<Inputs, Outputs, Weight>& layer,
                                  const std::vector<std::int64_t>& in) {
  std::vector<std::int64_t> sums;
  for (std::size_t j = 0; j < Outputs; ++j) {
    std::int64_t sum = layer.biases[j];
    for (std::size_t i = 0; i < Inputs; ++i) {
      sum += layer.weights[j][i] * in[i];
    }
    EXPECT_LE(std::abs(sum), std::numeric_limits<std::int32_t>::max()) << "the proof in the header is wrong";
    sums.push_back(sum);
  }
  return sums;
}

std::vector<std::int64_t> activate(std::vector<std::int64_t> sums, std::uint8_t shift) {
  for (std::int64_t& sum : sums) {
    sum = std::clamp<std::int64_t>((sum + (std::int64_t{1} << (shift - 1))) >> shift, 0, 32767);
  }
  return sums;
}

std::vector<std::int64_t> reference(const Raw& raw) {
  std::vector<std::int64_t> in;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const InputScale& scale = built_in.input_scales[i];
    const auto half = std::int64_t{1} << (scale.shift - 1);
    in.push_back(std::clamp<std::int64_t>((std::int64_t{raw[i]} * scale.multiplier + half) >> scale.shift,
                                          -32767, 32767));
  }
  [&]<std::size_t... n>(std::index_sequence<n...>) {
    ((in = activate(sums_of(built_in.layer<n>(), in), built_in.layer<n>().shift)), ...);
  }
  (std::make_index_sequence<built_in.hidden_layers>{});
  return sums_of(built_in.output, in);
}

void expect_agreement(const Raw& raw) {
  const auto wanted = reference(raw);
  const auto got = tested_infer<built_in>(raw);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    ASSERT_EQ(got.sums[k], wanted[k]);
  }
  ASSERT_EQ(got.action, std::max_element(wanted.begin(), wanted.end()) - wanted.begin());
}

TEST(Network, AgreesWithTheReferenceOnRandomInputs) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> bits(0, 31);
  for (int i = 0; i < 5'000; ++i) {
    Raw raw{};
    for (std::int32_t& element : raw) {
      element = static_cast<std::int32_t>(random()) >> bits(random);
    }
    expect_agreement(raw);
  }
}

// Every sign pattern at the ends of the input range drives the first layer as far as it goes.
TEST(Network, AgreesWithTheReferenceAtTheEndsOfTheRange) {
  for (unsigned pattern = 0; pattern < (1U << built_in.inputs); ++pattern) {
    Raw raw{};
    for (std::size_t i = 0; i < raw.size(); ++i) {
      raw[i] = ((pattern >> i) & 1U) != 0 ? std::numeric_limits<std::int32_t>::max()
                                          : std::numeric_limits<std::int32_t>::min();
    }
    expect_agreement(raw);
  }
}

TEST(Network, AnswersItsGoldenVectors) {
  for (const auto& golden : built_in.golden_vectors) {
    const auto q = tested_infer<built_in>(golden.raw);
    EXPECT_EQ(q.sums, golden.sums);
    EXPECT_EQ(q.action, golden.action);
  }
}

template <const auto& policy>
void expect_sound() {
  static_assert(scales_are_valid(policy) && sums_fit(policy) && inputs_are_known(policy) &&
                identity_of(policy) == policy.identity);
  for (const auto& golden : policy.golden_vectors) {
    const auto q = infer<policy>(golden.raw);
    EXPECT_EQ(q.sums, golden.sums);
    EXPECT_EQ(q.action, golden.action);
  }
}

// What is exported beside the built-in policy is as sound.
TEST(Network, TheOtherHeadersProveThemselvesAndPassTheirGoldenVectors) {
  expect_sound<kick_dqn>();
  expect_sound<aimed>();
}

TEST(Network, OfEqualActionsTheLowestIsChosen) {
  static constexpr Policy<1, 1, 1, 4, 1> flat = [] {
    Policy<1, 1, 1, 4, 1> p{};
    p.input_scales[0] = {1, 1};
    p.layer1.shift = 1;
    p.layer2.shift = 1;
    p.output.biases = {3, 9, 9, 9};
    return p;
  }();
  EXPECT_EQ(tested_infer<flat>({0}).action, 1);
}

// No int8 weights can: there a bias has to.
TEST(Proof, AWeightOrBiasThatCouldOverflowIsRefused) {
  auto heavy = built_in;
  EXPECT_TRUE(sums_fit(heavy));
  using Weight = decltype(heavy)::Weight;
  heavy.layer1.weights[0].fill(std::numeric_limits<Weight>::max());
  EXPECT_EQ(sums_fit(heavy), sizeof(Weight) == 1);
  heavy = built_in;
  heavy.output.biases[0] = std::numeric_limits<std::int32_t>::max();
  EXPECT_FALSE(sums_fit(heavy));
}

TEST(Proof, EveryAlterationChangesTheIdentity) {
  const auto altered = [](auto change) {
    auto copy = built_in;
    change(copy);
    return identity_of(copy) != built_in.identity;
  };
  EXPECT_EQ(identity_of(built_in), built_in.identity);
  for (std::size_t j = 0; j < built_in.widths[1]; ++j) {
    EXPECT_TRUE(altered([&](auto& p) { p.layer1.weights[j][j % built_in.inputs] ^= 1; }));
  }
  for (std::size_t j = 0; j < built_in.output.weights[0].size(); ++j) {
    EXPECT_TRUE(altered([&](auto& p) { p.output.weights[j % built_in.actions][j] ^= 1; }));
  }
  if constexpr (built_in.hidden_layers >= 2) {
    EXPECT_TRUE(altered([](auto& p) { p.layer2.weights[0][0] ^= 1; }));
    EXPECT_TRUE(altered([](auto& p) { p.layer2.shift ^= 1; }));
  }
  if constexpr (built_in.hidden_layers >= 3) {
    EXPECT_TRUE(altered([](auto& p) { p.layer3.weights[0][0] ^= 1; }));
    EXPECT_TRUE(altered([](auto& p) { p.layer3.biases[0] += 1; }));
  }
  EXPECT_TRUE(altered([](auto& p) { p.layer1.biases[0] += 1; }));
  EXPECT_TRUE(altered([](auto& p) { p.layer1.shift = static_cast<std::uint8_t>(p.layer1.shift + 1); }));
  EXPECT_TRUE(altered([](auto& p) { p.input_scales[0].multiplier += 1; }));
  EXPECT_TRUE(altered([](auto& p) { p.set_points[0].left_mm_s += 1; }));
  EXPECT_TRUE(altered([](auto& p) { p.golden_vectors[0].sums[0] += 1; }));
  EXPECT_TRUE(altered([](auto& p) { p.decision_period_ms += 1; }));
  EXPECT_TRUE(altered([](auto& p) { p.configuration_hash += 1; }));
}

}  // namespace
}  // namespace striker::policy
