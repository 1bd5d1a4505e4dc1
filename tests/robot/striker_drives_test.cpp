// SPDX-License-Identifier: Apache-2.0
// The drives' own watchdog and receive checks.
#include "sil/robot/striker_drives.hpp"

#include <gtest/gtest.h>

namespace striker::sil {
namespace {

TEST(StrikerDrives, CutTheTorqueTenMillisecondsAfterTheLastCommand) {
  StrikerDrives drives;
  can::SendCounter counter;
  EXPECT_TRUE(drives.cut(0)) << "no command yet";
  drives.take(can::send(can::WheelCommand{.left_torque_mNm = 300}, counter), 100);
  for (std::uint32_t tick = 100; tick < 110; ++tick) {
    EXPECT_FALSE(drives.cut(tick));
  }
  EXPECT_TRUE(drives.cut(110));
}

TEST(StrikerDrives, ABadCommandIsIgnoredCountedAndFeedsNothing) {
  StrikerDrives drives;
  can::SendCounter counter;
  drives.take(can::send(can::WheelCommand{.left_torque_mNm = 300}, counter), 0);
  can::Frame bad = can::send(can::WheelCommand{.left_torque_mNm = -300}, counter);
  bad.data[3] ^= 0x10U;
  drives.take(bad, 5);
  EXPECT_EQ(drives.orders()[0].torque_Nm, 300 * 1e-3);
  EXPECT_EQ(drives.ignored(), 1U);
  EXPECT_TRUE(drives.cut(10));
}

TEST(StrikerDrives, AControllerThatComesBackMayCountFromAnywhere) {
  for (std::uint8_t start = 0; start < 16; ++start) {
    StrikerDrives drives;
    can::SendCounter counter;
    drives.take(can::send(can::WheelCommand{}, counter), 0);
    counter.next = start;
    drives.take(can::send(can::WheelCommand{.left_torque_mNm = 7}, counter), 50);
    EXPECT_EQ(drives.orders()[0].torque_Nm, 7 * 1e-3) << int{start};
  }
}

}  // namespace
}  // namespace striker::sil
