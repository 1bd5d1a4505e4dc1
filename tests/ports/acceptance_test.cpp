// SPDX-License-Identifier: Apache-2.0
// Acceptance filters: whatever the controller listens to passes, and little else.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "firmware/can/controller_receives.hpp"
#include "firmware/can/drives/striker_drives.hpp"
#include "firmware/ports/bare_metal/can_driver/acceptance.hpp"

namespace striker::bare_metal {

namespace {

template <std::size_t count>
bool passes(const std::array<AcceptanceFilter, count>& filters, std::uint16_t id) {
  return std::any_of(filters.begin(), filters.end(), [id](const auto& filter) { return filter.passes(id); });
}

template <std::size_t count>
int passing(const std::array<AcceptanceFilter, count>& filters) {
  int all = 0;
  for (std::uint16_t id = 0; id <= every_bit_of_identifier; ++id) {
    all += passes(filters, id) ? 1 : 0;
  }
  return all;
}

TEST(Acceptance, WhatTheControllerListensToPasses) {
  constexpr auto ids = can::controller_receives<can::StrikerDrives>;
  for (const std::uint16_t id : ids) {
    EXPECT_TRUE(passes(acceptance_filters<1>(ids), id)) << id;
    EXPECT_TRUE(passes(acceptance_filters<4>(ids), id)) << id;
    EXPECT_TRUE(passes(acceptance_filters<14>(ids), id)) << id;
  }
  EXPECT_LT(passing(acceptance_filters<4>(ids)), 64);
  EXPECT_EQ(passing(acceptance_filters<14>(ids)), static_cast<int>(ids.size()));
}

TEST(Acceptance, AnyIdentifiersPassTheirFilters) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::array<std::uint16_t, 12> ids{};
    for (auto& id : ids) {
      id = static_cast<std::uint16_t>(random() & every_bit_of_identifier);
    }
    const auto filters = acceptance_filters<4>(ids);
    for (const std::uint16_t id : ids) {
      ASSERT_TRUE(passes(filters, id)) << "round " << round << ", identifier " << id;
    }
  }
}

TEST(Acceptance, FiltersThatAreNotNeededPassNothingMore) {
  constexpr auto filters = acceptance_filters<4>(std::array<std::uint16_t, 2>{0x123, 0x7FF});
  EXPECT_EQ(passing(filters), 2);
}

TEST(Acceptance, NeighboursShareAFilter) {
  constexpr auto filters = acceptance_filters<2>(std::array<std::uint16_t, 3>{0x100, 0x7FF, 0x101});
  EXPECT_EQ(passing(filters), 3);
}

}  // namespace

}  // namespace striker::bare_metal
