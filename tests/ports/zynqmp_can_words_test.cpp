// SPDX-License-Identifier: Apache-2.0
// How the Zynq UltraScale+'s CAN controller has frames and filters, and how QEMU's model has them: both pinned.
#include <gtest/gtest.h>

#include <random>

#include "firmware/ports/boards/zcu102-r5/can_words.hpp"

namespace striker::zcu102 {

namespace {

constexpr can::Frame sample = {.id = 0x123, .length = 6, .data = {0x11, 0x22, 0x33, 0x44, 0x55, 0x66}};

// AMD UG1087: TXFIFO_ID[31:21] the identifier, TXFIFO_DLC[31:28] the length, TXFIFO_DATA1[31:24] byte 0.
TEST(ZynqmpCanWords, AreTheHardwares) {
  constexpr FrameWords words = CanWords<Encoding::hardware>::encode(sample);
  EXPECT_EQ(words, (FrameWords{0x24600000, 0x60000000, 0x11223344, 0x55660000}));
}

// hw/net/can/xlnx-zynqmp-can.c of QEMU 7.2: the identifier's word goes to the bus as it is, byte 0 is DATA1[7:0].
TEST(ZynqmpCanWords, AreQemus) {
  constexpr FrameWords words = CanWords<Encoding::qemu>::encode(sample);
  EXPECT_EQ(words, (FrameWords{0x00000123, 0x60000000, 0x44332211, 0x00006655}));
}

template <Encoding encoding>
void expect_round_trip() {
  using Words = CanWords<encoding>;
  std::mt19937 random(1);
  for (int round = 0; round < 10'000; ++round) {
    can::Frame frame = {.id = static_cast<std::uint16_t>(random() & 0x7FFU),
                        .length = static_cast<std::uint8_t>(random() % 9)};
    for (std::size_t i = 0; i < frame.length; ++i) {
      frame.data[i] = static_cast<std::uint8_t>(random());
    }
    FrameWords words = Words::encode(frame);
    words.length |= static_cast<std::uint32_t>(random() & 0xFFFFU);  // a received frame's time stamp
    can::Frame decoded = {.id = 0x7FF, .length = 8, .data = {9, 9, 9, 9, 9, 9, 9, 9}};
    ASSERT_TRUE(Words::decode(words, decoded));
    ASSERT_EQ(decoded, frame);
  }
}

TEST(ZynqmpCanWords, ComeBackAsTheyWent) {
  expect_round_trip<Encoding::hardware>();
  expect_round_trip<Encoding::qemu>();
}

template <Encoding encoding>
void expect_refused(FrameWords words) {
  can::Frame frame = sample;
  EXPECT_FALSE(CanWords<encoding>::decode(words, frame)) << std::hex << words.id << " " << words.length;
  EXPECT_EQ(frame, sample) << "a refused frame leaves what was there";
}

TEST(ZynqmpCanWords, OnlyStandardDataFramesAreFrames) {
  for (const std::uint32_t flag : {1U << 20U, 1U << 19U}) {  // remote, extended
    expect_refused<Encoding::hardware>({.id = 0x24600000 | flag, .length = 0});
  }
  for (const std::uint32_t flag : {1U << 29U, 1U << 30U, 1U << 31U}) {  // error, remote, extended
    expect_refused<Encoding::qemu>({.id = 0x123 | flag, .length = 0});
  }
  expect_refused<Encoding::hardware>({.id = 0x24600000, .length = 9U << 28U});
  expect_refused<Encoding::qemu>({.id = 0x123, .length = 9U << 28U});
}

template <Encoding encoding>
void expect_filter_agrees(std::uint32_t other_formats) {
  using Words = CanWords<encoding>;
  constexpr bare_metal::AcceptanceFilter filter = {.id = 0x040, .mask = 0x7F3};
  constexpr FilterWords words = Words::encode(filter);
  const auto passes = [&](std::uint32_t id) { return ((id ^ words.id) & words.mask) == 0; };
  for (std::uint16_t id = 0; id <= 0x7FF; ++id) {
    const FrameWords frame = Words::encode(can::Frame{.id = id});
    ASSERT_EQ(passes(frame.id), filter.passes(id)) << id;
    for (std::uint32_t flag = 1; flag != 0; flag <<= 1U) {
      ASSERT_FALSE((flag & other_formats) != 0 && passes(frame.id | flag)) << id << " with " << flag;
    }
  }
}

TEST(ZynqmpCanWords, AFilterPassesWhatItSaysAndNoOtherFormat) {
  expect_filter_agrees<Encoding::hardware>(1U << 20U | 1U << 19U);
  expect_filter_agrees<Encoding::qemu>(7U << 29U);
}

// BRPR and BTR hold each value less one: 5 clocks a quantum, 14 + 5 quanta after the first, jump width 4.
TEST(ZynqmpCanWords, TheBitTimingIsOneMegabitWithItsSampleAtThreeQuarters) {
  constexpr BitTiming timing = bit_timing(100'000'000);
  EXPECT_EQ(timing.prescaler, 4U);
  EXPECT_EQ((timing.segments & 0xFU) + 1, 14U);
  EXPECT_EQ((timing.segments >> 4U & 0x7U) + 1, 5U);
  EXPECT_EQ((timing.segments >> 7U) + 1, 4U);
  EXPECT_EQ(bit_timing(99'990'001).prescaler, 4U);
}

TEST(ZynqmpCanWords, AClockThatGivesNoMegabitDoesNotCompile) {
  EXPECT_TRUE(suits_bit_rate(100'000'000));
  EXPECT_TRUE(suits_bit_rate(99'990'001));
  EXPECT_TRUE(suits_bit_rate(20'000'000));
  EXPECT_FALSE(suits_bit_rate(99'000'000));
  EXPECT_FALSE(suits_bit_rate(50'000'000));
  EXPECT_FALSE(suits_bit_rate(8'000'000));
}

}  // namespace

}  // namespace striker::zcu102
