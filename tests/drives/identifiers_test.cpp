// SPDX-License-Identifier: Apache-2.0
// Which nodes of others lie over Striker's own identifiers where these are not moved: over all nodes.
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "firmware/can/drives/cia402_drives.hpp"
#include "firmware/can/drives/odrive_drives.hpp"

namespace striker::can {
namespace {

// 48 is free itself. Nodes that collide with it as their fellow.
template <template <DriveWiring> class Drives, std::int32_t... node>
std::set<int> colliding(std::integer_sequence<std::int32_t, node...>) {
  constexpr std::int32_t fellow = 48;
  std::set<int> found;
  ((shares_no_identifier<
        Drives<DriveWiring{.left_node = node + 1, .right_node = node + 1 == fellow ? 49 : fellow}>>()
        ? void()
        : void(found.insert(node + 1))),
   ...);
  return found;
}

TEST(Identifiers, OdriveNodesThatCollide) {
  // Written down here, not taken from the table. Node 0 is left out, for the template's sake; it does as well (0x010).
  EXPECT_EQ(colliding<OdriveDrives>(std::make_integer_sequence<std::int32_t, 62>{}),
            (std::set<int>{1, 2, 3, 4, 8, 9, 56}));
  EXPECT_FALSE((shares_no_identifier<OdriveDrives<DriveWiring{.left_node = 0, .right_node = 48}>>()));
}

// SYNC (0x080) and TIME (0x100) are there with every node.
TEST(Identifiers, CanopenAlwaysCollides) {
  EXPECT_EQ(colliding<Cia402Drives>(std::make_integer_sequence<std::int32_t, 127>{}).size(), 127U);
}

}  // namespace
}  // namespace striker::can
