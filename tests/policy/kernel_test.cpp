// SPDX-License-Identifier: Apache-2.0
// The kernel of this build against the portable one, on networks of many shapes: the same bits.
#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/policy/built_in.hpp"
#include "firmware/policy/kernel/int16/portable.hpp"
#include "firmware/policy/kernel/int8/plain.hpp"
#include "firmware/policy/kernel/kernel.hpp"
#include "firmware/policy/network.hpp"
#include "firmware/policy/proof.hpp"
#include "tests/policy/synthetic_policy.hpp"
#include "tests/policy/tested_infer.hpp"

namespace striker::policy {
namespace {

// The contract refuses what cannot read the weights, or lacks a part.
static_assert(kernel::KernelFor<kernel::int16::Portable, std::int16_t>);
static_assert(kernel::KernelFor<kernel::int16::Portable, std::int8_t>);
static_assert(kernel::KernelFor<kernel::int8::Plain, std::int8_t>);
static_assert(!kernel::KernelFor<kernel::int8::Plain, std::int16_t>);
static_assert(!kernel::KernelFor<int, std::int16_t>);

template <const auto& policy>
void expect_same_bits() {
  constexpr std::size_t inputs = std::remove_cvref_t<decltype(policy)>::inputs;
  static_assert(sums_fit(policy));
  SmallRandom random(1);
  for (int i = 0; i < 2'000; ++i) {
    std::array<std::int32_t, inputs> raw{};
    std::generate(raw.begin(), raw.end(), [&] { return draw_raw(random); });
    const auto wanted = infer<policy, kernel::int16::Portable>(raw);
    const auto got = tested_infer<policy>(raw);
    ASSERT_EQ(got.sums, wanted.sums) << TestedKernel<policy>::name << ", input " << i;
    ASSERT_EQ(got.action, wanted.action) << TestedKernel<policy>::name << ", input " << i;
  }
}

TEST(Kernel, GivesThePortableBitsForEveryShape) {
#ifdef __AVX2__
  if (!__builtin_cpu_supports("avx2")) {
    GTEST_SKIP() << "this processor has no AVX2";
  }
#endif
  expect_same_bits<policy::built_in>();
  expect_same_bits<synthetic_smallest>();
  expect_same_bits<synthetic_odd>();
  expect_same_bits<synthetic_rest>();
  expect_same_bits<synthetic_half>();
  expect_same_bits<synthetic_paper>();
  expect_same_bits<synthetic_wide>();
  expect_same_bits<synthetic_shallow_smallest>();
  expect_same_bits<synthetic_shallow_odd>();
  expect_same_bits<synthetic_shallow_widest>();
  expect_same_bits<synthetic_deep_smallest>();
  expect_same_bits<synthetic_deep_narrow>();
  expect_same_bits<synthetic_deep_odd>();
  expect_same_bits<synthetic_deep_paper>();
}

TEST(Kernel, GivesThePortableBitsForEveryShapeOfInt8) {
  expect_same_bits<synthetic_int8_smallest>();
  expect_same_bits<synthetic_int8_odd>();
  expect_same_bits<synthetic_int8_rest>();
  expect_same_bits<synthetic_int8_paper>();
  expect_same_bits<synthetic_int8_wide>();
  expect_same_bits<synthetic_int8_shallow>();
  expect_same_bits<synthetic_int8_deep>();
  expect_same_bits<synthetic_int8_deep_paper>();
}

// A byte each, but for what fills a kernel's last words.
TEST(Kernel, PacksInt8IntoBytes) {
  constexpr std::size_t inputs = 6;
  constexpr std::size_t hidden = 64;
  constexpr std::size_t actions = 3;
  constexpr std::size_t weights = inputs * hidden + hidden * hidden + hidden * actions;
  constexpr std::size_t biases = (hidden + hidden + actions) * sizeof(std::int32_t);
  EXPECT_LE(Packed<synthetic_int8_paper>::bytes, weights + biases + 2 * hidden);
}

// The scaled input as policy.hpp has it, word by word.
std::int32_t specified(std::int32_t raw, const InputScale& scale) {
  const auto half = std::int64_t{1} << (scale.shift - 1);
  return static_cast<std::int32_t>(
      std::clamp<std::int64_t>((std::int64_t{raw} * scale.multiplier + half) >> scale.shift, -32767, 32767));
}

template <std::int32_t multiplier, std::uint8_t shift>
void expect_scaling() {
  static constexpr InputScale scale{multiplier, shift};
  SmallRandom random(multiplier + shift);
  for (int i = 0; i < 20'000; ++i) {
    const std::int32_t raw = draw_raw(random);
    ASSERT_EQ(kernel::scale_input<scale>(raw), specified(raw, scale))
        << raw << " " << multiplier << " " << int{shift};
    constexpr int bits = kernel::relevant_bits(scale);
    if constexpr (bits < 31) {
      ASSERT_EQ(specified(kernel::saturate_to<bits>(raw), scale), specified(raw, scale)) << raw;
      if constexpr (kernel::splits(scale)) {
        ASSERT_EQ(std::clamp(kernel::scale_split<scale>(kernel::saturate_to<bits>(raw)), -32767, 32767),
                  specified(raw, scale))
            << raw << " " << multiplier << " " << int{shift};
      }
    }
  }
}

TEST(Kernel, ScalesInputsAsSpecifiedAtEveryShift) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (expect_scaling<1, i + 1>(), ...);
    (expect_scaling<1 << 20, i + 1>(), ...);
    (expect_scaling<842'150, i + 1>(), ...);
    (expect_scaling<777, i + 1>(), ...);
  }
  (std::make_index_sequence<40>{});
}

}  // namespace
}  // namespace striker::policy
