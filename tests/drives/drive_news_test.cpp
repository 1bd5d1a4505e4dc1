// SPDX-License-Identifier: Apache-2.0
// What single frames of ODrives and of drives of CiA 402 are taken for; bytes written down from the manuals.
#include <gtest/gtest.h>

#include <cmath>

#include "firmware/can/drives/cia402_drives.hpp"
#include "firmware/can/drives/odrive_drives.hpp"

namespace striker::can {
namespace {

// A wheel of 40 mm: 251,327 um a turn. The right motor is mirrored.
using Odrives = OdriveDrives<DriveWiring{.left_node = 16, .right_node = 17, .right_reversed = 1}>;
using Cia402 = Cia402Drives<DriveWiring{.left_node = 1, .right_node = 2, .right_reversed = 1}>;

TEST(OdriveNews, SpeedsAreOfTheRim) {
  // 0.0 turns, 2.0 and -0.5 turns a second.
  const DriveNews left = Odrives::news_of({.id = 0x209, .length = 8, .data = {0, 0, 0, 0, 0, 0, 0, 0x40}});
  EXPECT_EQ(left.wheel, left_wheel);
  EXPECT_EQ(left.speed_mm_s, 503) << "502.65";
  EXPECT_FALSE(left.is_enabled);
  const DriveNews right = Odrives::news_of({.id = 0x229, .length = 8, .data = {0, 0, 0, 0, 0, 0, 0, 0xBF}});
  EXPECT_EQ(right.wheel, right_wheel);
  EXPECT_EQ(right.speed_mm_s, 126) << "125.66, and mirrored";
}

TEST(OdriveNews, WhatIsNoSpeedIsOutOfRange) {
  const auto verdict = [](std::array<std::uint8_t, 8> data) {
    return Odrives::news_of({.id = 0x209, .length = 8, .data = data}).verdict;
  };
  EXPECT_EQ(verdict({0, 0, 0, 0, 0, 0, 0xC0, 0x7F}), Verdict::out_of_range) << "NaN";
  EXPECT_EQ(verdict({0, 0, 0, 0, 0, 0, 0x80, 0xFF}), Verdict::out_of_range) << "-infinity";
  EXPECT_EQ(verdict({0, 0, 0xC0, 0x7F, 0, 0, 0, 0}), Verdict::out_of_range) << "a position of NaN";
  EXPECT_EQ(verdict({0, 0, 0, 0, 0, 0, 0, 0x42}), Verdict::out_of_range) << "32 turns a second: 8,042 mm/s";
  EXPECT_EQ(Odrives::news_of({.id = 0x209, .length = 7}).verdict, Verdict::wrong_length);
}

TEST(OdriveNews, EnabledIsClosedLoopWithoutAnError) {
  const auto enabled = [](std::uint16_t id, std::array<std::uint8_t, 8> data) {
    return Odrives::news_of({.id = id, .length = 8, .data = data}).is_enabled;
  };
  EXPECT_EQ(enabled(0x201, {0, 0, 0, 0, 8}), true);
  EXPECT_EQ(enabled(0x201, {0, 0, 0, 0, 1}), false);
  EXPECT_EQ(enabled(0x201, {0, 0, 0, 1, 8}), false) << "WATCHDOG_TIMER_EXPIRED";
  EXPECT_EQ(enabled(0x203, {0x20, 0, 0, 0}), false) << "Get_Error";
  EXPECT_EQ(enabled(0x203, {0, 0, 0, 0, 0x20}), std::nullopt) << "why it disarmed once says nothing of now";
}

TEST(Cia402News, SpeedAndStateComeTogether) {
  // 16,384 counts a second: one turn.
  const DriveNews left = Cia402::news_of({.id = 0x181, .length = 6, .data = {0x37, 0x12, 0x00, 0x40, 0, 0}});
  EXPECT_EQ(left.speed_mm_s, 251);
  EXPECT_EQ(left.is_enabled, true);
  const DriveNews right =
      Cia402::news_of({.id = 0x182, .length = 6, .data = {0x33, 0x02, 0x00, 0xC0, 0xFF, 0xFF}});
  EXPECT_EQ(right.wheel, right_wheel);
  EXPECT_EQ(right.speed_mm_s, 251) << "mirrored";
  EXPECT_EQ(right.is_enabled, false) << "switched on is not enabled";
  EXPECT_EQ(Cia402::news_of({.id = 0x181, .length = 6, .data = {0x37, 0x12, 0, 0, 0, 0x7F}}).verdict,
            Verdict::out_of_range);
  EXPECT_EQ(Cia402::news_of({.id = 0x181, .length = 8}).verdict, Verdict::wrong_length);
}

TEST(Cia402News, AnEmergencyAndANodeThatIsNotOperationalAreNotEnabled) {
  EXPECT_EQ(Cia402::news_of({.id = 0x081, .length = 8, .data = {0x30, 0x81}}).is_enabled, false);
  EXPECT_EQ(Cia402::news_of({.id = 0x081, .length = 8}).is_enabled, std::nullopt) << "the error is over";
  EXPECT_EQ(Cia402::news_of({.id = 0x702, .length = 1, .data = {0x7F}}).is_enabled, false);
  EXPECT_EQ(Cia402::news_of({.id = 0x702, .length = 1, .data = {0x05}}).is_enabled, std::nullopt);
}

// Against the exact quotient, for gears, wheels and encoders from one end of their ranges to the other.
template <std::int32_t radius_um, std::int32_t gear_percent, std::int32_t counts>
void expect_right_speeds() {
  constexpr DriveWiring wiring = {.left_node = 1,
                                  .right_node = 2,
                                  .gear_percent = gear_percent,
                                  .counts_per_turn = counts,
                                  .wheel_radius_um = radius_um};
  for (std::int32_t speed_mm_s = -7'900; speed_mm_s <= 7'900; speed_mm_s += 79) {
    const double counts_per_s = std::round(speed_mm_s * 1e3 / wiring.rim_um_per_turn() * counts);
    if (std::abs(counts_per_s) > 0x7FFF'FFFF) {
      continue;
    }
    Frame frame = {.id = 0x181, .length = 6};
    put_little_endian_32(frame, 2, static_cast<std::uint32_t>(static_cast<std::int32_t>(counts_per_s)));
    const double exact_mm_s = counts_per_s / counts * wiring.rim_um_per_turn() * 1e-3;
    ASSERT_NEAR(Cia402Drives<wiring>::news_of(frame).speed_mm_s.value_or(99'999), exact_mm_s, 0.51)
        << radius_um << " um, gear " << gear_percent << ", " << counts;
  }
}

TEST(Cia402News, SpeedsAreExactForEveryGearAndEncoder) {
  expect_right_speeds<10'900, 10'000, 10'000'000>();
  expect_right_speeds<40'000, 10'000, 1 << 23>();
  expect_right_speeds<40'000, 500, 16'384>();
  expect_right_speeds<40'000, 100, 100>();
  expect_right_speeds<500'000, 10, 100>();
  expect_right_speeds<500'000, 10, 10'000'000>();
}

// What the drive is told is never more than was wanted, and the gate never sees less than that.
TEST(Cia402Torque, IsCutToThePerMilleBelow) {
  using Geared = Cia402Drives<DriveWiring{
      .left_node = 1, .right_node = 2, .right_reversed = 1, .gear_percent = 333, .rated_torque_mNm = 77}>;
  for (std::int32_t torque_mNm = -2'000; torque_mNm <= 2'000; ++torque_mNm) {
    Frame frame = {.id = 0x201, .length = 5};
    Geared::recode(frame, {.torque = {torque_mNm, 0}, .set_point = {}});
    const auto per_mille = static_cast<std::int16_t>(frame.data[2] | frame.data[3] << 8);
    const double told_mNm = per_mille * 0.077 * 3.33;
    const std::int32_t seen_mNm = Geared::command_of(frame).torque.left_mNm;
    ASSERT_LE(std::abs(told_mNm), std::abs(torque_mNm) + 1e-9);
    ASSERT_GT(std::abs(told_mNm), std::abs(torque_mNm) - 0.077 * 3.33 - 1e-9);
    ASSERT_GE(std::abs(seen_mNm), std::abs(told_mNm) - 1e-9);
    ASSERT_LE(std::abs(seen_mNm), std::abs(torque_mNm));
  }
}

}  // namespace
}  // namespace striker::can
