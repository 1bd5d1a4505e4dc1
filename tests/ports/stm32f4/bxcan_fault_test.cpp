// SPDX-License-Identifier: Apache-2.0
// The STM32F4's CAN driver against the modelled controller: no peer, bus-off and the way back.
#include <random>

#include "tests/ports/stm32f4/bxcan_fixture.hpp"

namespace striker::stm32f4 {

namespace {

using can::BusHealth;
using model::Outcome;

TEST_F(BxCanBus, WithoutAPeerItIsErrorPassiveAndNeverOff) {
  join();
  for (; now_ms < 1'000; ++now_ms) {
    static_cast<void>(driver.try_send(frame_of(0x050), now_ms));
    for (int attempt = 0; attempt < 7; ++attempt) {
      static_cast<void>(transmit(Outcome::unacknowledged));
    }
    ASSERT_NE(driver.health(now_ms), BusHealth::bus_off);
  }
  EXPECT_EQ(driver.health(now_ms), BusHealth::error_passive);
}

// A command that waited for a cable must not move a wheel when that is plugged in.
TEST_F(BxCanBus, NoFrameGoesThatIs10MillisecondsOld) {
  join();
  std::minstd_rand random(3);
  for (; now_ms < 3'000; ++now_ms) {
    can::Frame frame = frame_of(static_cast<std::uint16_t>(0x050 + 0x010 * (random() % 4)));
    frame.data[0] = static_cast<std::uint8_t>(now_ms);
    frame.data[1] = static_cast<std::uint8_t>(now_ms >> 8U);
    static_cast<void>(driver.try_send(frame, now_ms));
    settle();
    const bool is_plugged = now_ms / 40 % 2 == 0;
    for (int sent = 0; sent < 2; ++sent) {
      if (const auto on_wire = transmit(is_plugged ? Outcome::acknowledged : Outcome::unacknowledged)) {
        const std::uint32_t since = std::uint32_t{on_wire->data[0]} | std::uint32_t{on_wire->data[1]} << 8U;
        ASSERT_LT(now_ms - since, bare_metal::transmit_timeout_ticks);
      }
    }
  }
}

TEST_F(BxCanBus, AFrameOnTheWireAtItsTimeoutEndsThere) {
  join();
  ASSERT_TRUE(driver.try_send(frame_of(0x050), now_ms));
  settle();
  ASSERT_TRUE(model.begin_transmission());
  now_ms += bare_metal::transmit_timeout_ticks;
  settle();
  model.end_transmission(Outcome::unacknowledged);
  settle();
  EXPECT_FALSE(model.holds_frames());
  EXPECT_FALSE(transmit());
}

TEST_F(BxCanBus, BusOffIsSeenOnceAtLeastAndTakesEverythingBack) {
  join();
  for (const int id : {0x060, 0x070, 0x100, 0x110, 0x120}) {
    ASSERT_TRUE(driver.try_send(frame_of(static_cast<std::uint16_t>(id)), now_ms));
  }
  go_bus_off();
  settle();
  ++now_ms;
  settle();
  model.recessive_bits(recovery_bits);
  settle();
  EXPECT_EQ(driver.health(now_ms), BusHealth::bus_off) << "though it is over";
  EXPECT_EQ(driver.health(now_ms), BusHealth::active);
  EXPECT_EQ(driver.bus_offs(), 1U);
  EXPECT_FALSE(model.holds_frames());
  EXPECT_TRUE(transmitted_ids().empty()) << "nothing from before";
  ASSERT_TRUE(driver.try_send(frame_of(0x050), now_ms));
  EXPECT_TRUE(transmit());
}

TEST_F(BxCanBus, ComesBackOnlyOnceEverythingWasTakenBack) {
  join();
  model.takes_back_at_once = false;
  go_bus_off();
  for (; now_ms < 50; ++now_ms) {
    settle();
    model.recessive_bits(recovery_bits);
    ASSERT_EQ(driver.health(now_ms), BusHealth::bus_off);
    ASSERT_FALSE(model.begin_transmission());
  }
  model.take_back_now();
  settle();
  model.recessive_bits(recovery_bits);
  settle();
  EXPECT_EQ(driver.health(now_ms), BusHealth::active);
  EXPECT_TRUE(transmitted_ids().empty());
}

TEST_F(BxCanBus, OffTheBusNothingIsTakenUntilTheBusHasBeenQuietFor128Times11Bits) {
  join();
  go_bus_off();
  for (; now_ms < 50; ++now_ms) {
    settle();
    ASSERT_FALSE(driver.try_send(frame_of(0x050), now_ms));
    ASSERT_EQ(driver.health(now_ms), BusHealth::bus_off);
  }
  model.recessive_bits(recovery_bits - 1);
  EXPECT_EQ(driver.health(now_ms), BusHealth::bus_off);
  model.recessive_bits(1);
  EXPECT_EQ(driver.health(now_ms), BusHealth::active);
  EXPECT_EQ(driver.bus_offs(), 1U) << "waiting is no bus-off of its own";
}

TEST_F(BxCanBus, EachBusOffWithoutAFrameSentDoublesTheRestUpTo256Milliseconds) {
  join();
  for (std::uint32_t times = 0, rest = 1; times < 12; ++times, rest = std::min(2 * rest, longest_rest_ms)) {
    go_bus_off();
    settle();
    const std::uint32_t off_since = now_ms;
    while (now_ms - off_since < 1'000 && driver.health(now_ms) == BusHealth::bus_off) {
      ++now_ms;
      settle();
      model.recessive_bits(recovery_bits);
    }
    EXPECT_EQ(now_ms - off_since, rest) << times;
    EXPECT_EQ(driver.bus_offs(), times + 1);
  }
  ASSERT_TRUE(driver.try_send(frame_of(0x050), now_ms));
  ASSERT_TRUE(transmit());
  go_bus_off();
  settle();
  now_ms += 1;
  settle();
  model.recessive_bits(recovery_bits);
  settle();
  static_cast<void>(driver.health(now_ms));
  EXPECT_EQ(driver.health(now_ms), BusHealth::active) << "a frame sent ends the doubling";
}

TEST_F(BxCanBus, AControllerThatNeverAcknowledgesStaysOff) {
  model.acknowledges_initialisation = false;
  driver.start(timing_value, listened);
  for (; now_ms < 1'000; ++now_ms) {
    ASSERT_EQ(driver.health(now_ms), BusHealth::bus_off);
    ASSERT_FALSE(driver.try_send(frame_of(0x050), now_ms));
    can::Frame frame;
    ASSERT_FALSE(driver.receive(frame, now_ms));
  }
}

}  // namespace

}  // namespace striker::stm32f4
