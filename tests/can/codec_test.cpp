// SPDX-License-Identifier: Apache-2.0
// The message table's packing and receive checks, for every message, by property.
#include "firmware/can/codec.hpp"

#include <gtest/gtest.h>

#include <random>

namespace striker::can {
namespace {

template <class Message>
Message draw(std::mt19937& random) {
  Message message;
  for (const auto& signal : layout<Message>.signals) {
    std::uniform_int_distribution<std::int32_t> value(signal.minimum, signal.maximum);
    message.*signal.field = value(random);
  }
  return message;
}

template <class Message>
void expect_equal(const Message& a, const Message& b) {
  for (const auto& signal : layout<Message>.signals) {
    EXPECT_EQ(a.*signal.field, b.*signal.field) << signal.name;
  }
}

template <class Message>
bool is_protected() {
  return layout<Message>.info.data_ids != unprotected;
}

// Calls check.operator()<Message>() for every message of the table.
template <class Check>
void for_each_message(Check check) {
  [&]<class... Message>(const std::tuple<Message...>*) {
    (check.template operator()<Message>(), ...);
  }(static_cast<const Messages*>(nullptr));
}

TEST(Codec, UnpackGivesBackWhatWasPacked) {
  std::mt19937 random(1);
  for_each_message([&]<class Message>() {
    for (int i = 0; i < 200; ++i) {
      const auto sent = draw<Message>(random);
      Message received;
      ASSERT_EQ(unpack(pack(sent), received), Verdict::accepted);
      expect_equal(sent, received);
    }
  });
}

TEST(Codec, ValuesOutsideARangeAreSentAsItsNearestEnd) {
  WheelCommand command{.left_torque_mNm = 99999, .right_torque_mNm = -99999};
  WheelCommand received;
  ASSERT_EQ(unpack(pack(command), received), Verdict::accepted);
  EXPECT_EQ(received.left_torque_mNm, 2000);
  EXPECT_EQ(received.right_torque_mNm, -2000);
}

// Profile 2's promise at these lengths: every error of one, two or three bits is found.
TEST(Codec, EveryErrorOfUpToThreeBitsIsFound) {
  std::mt19937 random(2);
  for_each_message([&]<class Message>() {
    if constexpr (layout<Message>.info.data_ids != unprotected) {
      SendCounter counter{static_cast<std::uint8_t>(random() % counter_modulus)};
      const Frame good = send(draw<Message>(random), counter);
      const unsigned bits = 8U * good.length;
      const auto refused = [&](std::uint64_t errors) {
        Frame bad = good;
        for (unsigned byte = 0; byte < bad.length; ++byte) {
          bad.data[byte] = static_cast<std::uint8_t>(bad.data[byte] ^ ((errors >> (8 * byte)) & 0xFFU));
        }
        Message message;
        return receive(bad, message) == Verdict::wrong_crc;
      };
      for (unsigned a = 0; a < bits; ++a) {
        for (unsigned b = a; b < bits; ++b) {
          for (unsigned c = b; c < bits; ++c) {
            const std::uint64_t errors = (1ULL << a) | (1ULL << b) | (1ULL << c);
            ASSERT_TRUE(refused(errors))
                << layout<Message>.info.name << " bits " << a << " " << b << " " << c;
          }
        }
      }
    }
  });
}

// A flipped counter bit changes the data ID too: every counter, on the frames that are longest and shortest.
template <class Message>
void expect_pairs_with_the_counter_found() {
  std::mt19937 random(3);
  for (std::uint8_t number = 0; number < counter_modulus; ++number) {
    SendCounter counter{number};
    const Frame good = send(draw<Message>(random), counter);
    for (unsigned in_counter = 8; in_counter < 12; ++in_counter) {
      for (unsigned other = 0; other < 8U * good.length; ++other) {
        Frame bad = good;
        bad.data[in_counter / 8] ^= static_cast<std::uint8_t>(1U << (in_counter % 8));
        bad.data[other / 8] ^= static_cast<std::uint8_t>(1U << (other % 8));
        Message message;
        ASSERT_TRUE(other == in_counter || receive(bad, message) == Verdict::wrong_crc)
            << int{number} << " " << in_counter << " " << other;
      }
    }
  }
}

TEST(Codec, NoFlipBesideOneOfTheCounterIsUndoneByTheDataIdThatItChanges) {
  expect_pairs_with_the_counter_found<WheelCommand>();
  expect_pairs_with_the_counter_found<EmergencyStop>();
}

TEST(Codec, AMessageOfAnotherKindIsRefusedByItsDataId) {
  SendCounter counter;
  Frame pose = send(VisionPose{}, counter);
  pose.id = layout<WheelCommand>.info.id;
  WheelCommand command;
  EXPECT_EQ(receive(pose, command), Verdict::wrong_crc);
}

TEST(Codec, AnyOtherLengthIsRefused) {
  for_each_message([&]<class Message>() {
    const Frame good = pack(Message{});
    for (std::uint8_t length = 0; length <= 8; ++length) {
      Frame frame = good;
      frame.length = length;
      Message message;
      EXPECT_EQ(unpack(frame, message) == Verdict::wrong_length, length != good.length);
    }
  });
}

TEST(Codec, AMessageWithOneSignalOutOfRangeIsIgnoredWhole) {
  SendCounter counter;
  Frame frame = send(ModeCommand{.mode = 0}, counter);
  frame.data[1] = static_cast<std::uint8_t>(frame.data[1] | 0xF0U);
  protect(frame, layout<ModeCommand>.info.data_ids, 1);
  ModeCommand command{.mode = 1};
  EXPECT_EQ(receive(frame, command), Verdict::out_of_range);
  EXPECT_EQ(command.mode, 1);
}

TEST(Codec, BothEndsOfARangeAreAcceptedAndNothingBeyond) {
  for (const std::int32_t speed_mm_s : {-8'001, -8'000, 8'000, 8'001}) {
    for (const std::size_t first_byte : {2U, 4U}) {  // the left speed, the right one
      SendCounter counter;
      Frame frame = send(WheelState{}, counter);
      frame.data[first_byte] = static_cast<std::uint8_t>(speed_mm_s);
      frame.data[first_byte + 1] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(speed_mm_s) >> 8U);
      protect(frame, layout<WheelState>.info.data_ids, 1);
      WheelState state;
      EXPECT_EQ(receive(frame, state),
                speed_mm_s < -8'000 || speed_mm_s > 8'000 ? Verdict::out_of_range : Verdict::accepted)
          << speed_mm_s;
    }
  }
}

TEST(Codec, AllThatCanMoveTheRobotIsProtected) {
  EXPECT_TRUE(is_protected<EmergencyStop>() && is_protected<Sync>() && is_protected<ModeCommand>() &&
              is_protected<WheelCommand>() && is_protected<WheelState>() && is_protected<VisionPose>() &&
              is_protected<VisionBall>() && is_protected<Status>() && is_protected<FaultReport>() &&
              is_protected<Challenge>() && is_protected<Safety>() && is_protected<EndOfTick>() &&
              is_protected<WheelOrder>() && is_protected<MotionOrder>());
}

// Bytes that were reckoned by hand, the CRC by another program.
TEST(Codec, AnOrdersBytesAreTheseEverywhere) {
  SendCounter team{5};
  const Frame wheels = send(WheelOrder{.left_mm_s = 300, .right_mm_s = -200}, team);
  EXPECT_EQ(wheels,
            (Frame{.id = 0x084, .length = 6, .data = {0x95, 0x05, 0x2C, 0x01, 0x38, 0xFF, 0x00, 0x00}}));
  team.next = 11;
  const Frame motion = send(
      MotionOrder{.number = 2, .motion = 0, .x_quarter_mm = -6000, .y_quarter_mm = 1000, .heading = 16384},
      team);
  EXPECT_EQ(motion,
            (Frame{.id = 0x088, .length = 8, .data = {0x21, 0x2B, 0x90, 0xE8, 0xE8, 0x03, 0x00, 0x40}}));
}

}  // namespace
}  // namespace striker::can
