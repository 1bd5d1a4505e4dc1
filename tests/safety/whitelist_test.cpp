// SPDX-License-Identifier: Apache-2.0
// Over every identifier and length: what may be sent is what the message table says the controller sends.
#include "firmware/safety/whitelist.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <utility>

#include "firmware/can/drives/striker_drives.hpp"

namespace striker::safety {
namespace {

TEST(Whitelist, HoldsTheControllersMessagesAndNothingElse) {
  // Written down here, not taken from the table.
  const std::set<std::pair<int, int>> wanted = {{0x020, 7}, {0x090, 6}, {0x050, 8}, {0x100, 8}, {0x108, 8},
                                                {0x110, 7}, {0x120, 8}, {0x700, 4}, {0x710, 6}, {0x7F0, 6}};
  for (int id = 0; id <= 0xFFFF; ++id) {
    for (int length = 0; length <= 8; ++length) {
      const can::Frame frame{
          .id = static_cast<std::uint16_t>(id), .length = static_cast<std::uint8_t>(length), .data = {}};
      ASSERT_EQ(may_send<can::StrikerDrives>(frame), wanted.contains({id, length})) << id << " " << length;
    }
  }
}

// Drives of another make, whose frames the message table does not have.
struct OtherDrives : can::StrikerDrives {
  static constexpr std::array<std::uint16_t, 2> sends = {0x00D, 0x02D};
};

TEST(Whitelist, FollowsTheDrivesThatAreSpokenTo) {
  EXPECT_TRUE(may_send<OtherDrives>({.id = 0x02D, .length = 8, .data = {}}));
  EXPECT_FALSE(may_send<can::StrikerDrives>({.id = 0x02D, .length = 8, .data = {}}));
  EXPECT_FALSE(may_send<OtherDrives>({.id = 0x040, .length = 2, .data = {}}));
}

}  // namespace
}  // namespace striker::safety
