// SPDX-License-Identifier: Apache-2.0
// Bits flipped in the weights that the image holds: every one is found within a second.
#include "firmware/policy/weights_check.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "firmware/policy/built_in.hpp"

namespace striker::policy {
namespace {

using Check = WeightsCheck<built_in>;
using Weights = Packed<built_in>;

// The layer's bytes, made writable: what a worn flash or a stray write would change.
template <class Layer>
std::span<unsigned char> writable(const Layer& layer) {
  auto* const bytes = reinterpret_cast<unsigned char*>(const_cast<Layer*>(&layer));
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const std::size_t before = reinterpret_cast<std::uintptr_t>(bytes) % page;
  EXPECT_EQ(mprotect(bytes - before, before + sizeof layer, PROT_READ | PROT_WRITE), 0);
  return {bytes, sizeof layer};
}

std::vector<std::span<unsigned char>> writable_layers() {
  return []<std::size_t... n>(std::index_sequence<n...>) {
    return std::vector{writable(Weights::layer<n>)...};
  }
  (std::make_index_sequence<Weights::layers>{});
}

std::uint32_t ticks_until_found(Check check) {
  std::uint32_t ticks = 0;
  while (check.step() && ticks < 2'000) {
    ++ticks;
  }
  return ticks;
}

TEST(WeightsCheck, AWholePassTakesHalfASecondAndFindsNothingInWhatWasExported) {
  Check check;
  for (int tick = 0; tick < 5'000; ++tick) {
    ASSERT_TRUE(check.step());
  }
  EXPECT_LE(Check::words / Check::words_a_tick + 3, 500U);
}

TEST(WeightsCheck, EveryFlippedBitIsFoundInItsPass) {
  for (const auto layer : writable_layers()) {
    for (std::size_t byte = 0; byte < layer.size(); ++byte) {
      for (unsigned bit = 0; bit<8; bit += layer.size()> 4096 ? 3 : 1) {
        layer[byte] = static_cast<unsigned char>(layer[byte] ^ 1U << bit);
        ASSERT_LE(ticks_until_found(Check()), 500U) << byte << " " << bit;
        layer[byte] = static_cast<unsigned char>(layer[byte] ^ 1U << bit);
      }
    }
  }
}

// Wherever the check stands when it happens.
TEST(WeightsCheck, WhatChangesBehindItIsFoundWithinASecond) {
  const auto layer = writable(Weights::layer<0>);
  for (std::uint32_t done = 0; done < 500; done += 7) {
    Check check;
    for (std::uint32_t tick = 0; tick < done; ++tick) {
      ASSERT_TRUE(check.step());
    }
    layer[2] ^= 4U;
    EXPECT_LE(ticks_until_found(check), 1'000U) << done;
    layer[2] ^= 4U;
  }
}

}  // namespace
}  // namespace striker::policy
