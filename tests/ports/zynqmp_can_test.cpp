// SPDX-License-Identifier: Apache-2.0
// The driver of the Zynq UltraScale+'s CAN controller on a model of its registers (zynqmp_can_model.hpp).
#include <gtest/gtest.h>

#include <vector>

#include "firmware/can/controller_receives.hpp"
#include "firmware/can/drives/striker_drives.hpp"
#include "firmware/ports/boards/zcu102-r5/zynqmp_can.hpp"
#include "tests/ports/zynqmp_can_model.hpp"

namespace striker::zcu102 {

namespace {

constexpr auto filters = bare_metal::acceptance_filters<4>(can::controller_receives<can::StrikerDrives>);

class ZynqmpCanTest : public testing::Test {
 protected:
  ZynqmpCanTest() { driver.start(bit_timing(100'000'000), filters); }

  static can::Frame frame(std::uint16_t id, std::uint8_t mark = 0) {
    return {.id = id, .length = 1, .data = {mark}};
  }

  void send_all() {
    while (model.transmit()) {
      driver.health(tick);
    }
  }

  std::vector<std::uint16_t> sent() const {
    std::vector<std::uint16_t> ids;
    for (const FrameWords& words : model.on_the_bus) {
      ids.push_back(static_cast<std::uint16_t>(words.id >> 21U));
    }
    return ids;
  }

  Model model;
  ZynqmpCan<Registers, Encoding::hardware> driver{Registers{&model}};
  std::uint32_t tick = 1'000;
};

TEST_F(ZynqmpCanTest, StartsWithTimingAndFiltersAndJoinsTheBus) {
  EXPECT_TRUE(model.enabled);
  EXPECT_EQ(model.resets, 1);
  EXPECT_EQ(model.prescaler, 4U);
  EXPECT_EQ(model.segments, bit_timing(100'000'000).segments);
  EXPECT_EQ(model.filters[0], 15U);
  for (std::size_t i = 0; i < 4; ++i) {
    const FilterWords words = Words::encode(filters[i]);
    EXPECT_EQ(model.filters[1 + 2 * i], words.mask);
    EXPECT_EQ(model.filters[2 + 2 * i], words.id);
  }
}

TEST_F(ZynqmpCanTest, ReceivesInOrderAndPassesOverOtherFormats) {
  can::Frame received;
  EXPECT_FALSE(driver.receive(received, tick));
  for (std::uint16_t id = 1; id <= 30; ++id) {
    model.receive(Words::encode(frame(id)));
    model.receive({.id = Words::encode(frame(id)).id | 1U << 20U});  // a remote frame
  }
  for (std::uint16_t id = 1; id <= 30; ++id) {
    ASSERT_TRUE(driver.receive(received, tick));
    EXPECT_EQ(received, frame(id));
  }
  EXPECT_FALSE(driver.receive(received, tick));
}

TEST_F(ZynqmpCanTest, TheLowestIdentifierGoesFirstAndPastOneThatWaits) {
  for (const std::uint16_t id : std::vector<std::uint16_t>{0x700, 0x120, 0x050, 0x100, 0x050}) {
    EXPECT_TRUE(driver.try_send(frame(id), tick));
  }
  send_all();
  EXPECT_EQ(sent(), (std::vector<std::uint16_t>{0x120, 0x050, 0x050, 0x100, 0x700}))
      << "0x700 is in the FIFO already, and 0x120 in the urgent buffer; nothing else is out of order";
}

TEST_F(ZynqmpCanTest, AFrameThatLosesArbitrationHoldsNothingMoreUrgentUp) {
  EXPECT_TRUE(driver.try_send(frame(0x700), tick));
  EXPECT_TRUE(driver.try_send(frame(0x050), tick));
  model.transmit();
  EXPECT_EQ(sent(), (std::vector<std::uint16_t>{0x050}));
}

TEST_F(ZynqmpCanTest, FramesOfOneIdentifierKeepTheirOrder) {
  for (std::uint8_t mark = 0; mark < 8; ++mark) {
    EXPECT_TRUE(driver.try_send(frame(0x050, mark), tick));
  }
  send_all();
  ASSERT_EQ(model.on_the_bus.size(), 8U);
  for (std::uint8_t mark = 0; mark < 8; ++mark) {
    EXPECT_EQ(model.on_the_bus[mark].data1 >> 24U, mark);
  }
}

TEST_F(ZynqmpCanTest, NothingGoesOutAfterTenMillisecondsWithoutAnAcknowledge) {
  for (const std::uint16_t id : std::vector<std::uint16_t>{0x700, 0x050, 0x100}) {
    EXPECT_TRUE(driver.try_send(frame(id), tick));
  }
  tick += 9;
  driver.health(tick);
  EXPECT_FALSE(model.fifo.empty());
  tick += 1;
  driver.health(tick);
  send_all();  // the cable is plugged in
  EXPECT_EQ(sent(), std::vector<std::uint16_t>{});
  EXPECT_EQ(driver.taken_back(), 3U);
  EXPECT_TRUE(model.enabled);
  EXPECT_TRUE(driver.try_send(frame(0x050), tick));
  send_all();
  EXPECT_EQ(sent(), std::vector<std::uint16_t>{0x050});
}

TEST_F(ZynqmpCanTest, AtBusOffEverythingIsDroppedAndItIsToldForATickAtLeast) {
  for (const std::uint16_t id : std::vector<std::uint16_t>{0x700, 0x050, 0x100}) {
    EXPECT_TRUE(driver.try_send(frame(id), tick));
  }
  model.events |= can_bits::bus_off;
  can::Frame received;
  EXPECT_FALSE(driver.receive(received, tick));
  EXPECT_FALSE(model.enabled);
  EXPECT_FALSE(driver.try_send(frame(0x100), tick));
  EXPECT_EQ(driver.health(tick), can::BusHealth::bus_off);
  tick += 3;
  EXPECT_EQ(driver.health(tick), can::BusHealth::active);
  EXPECT_TRUE(model.enabled);
  send_all();
  EXPECT_EQ(sent(), std::vector<std::uint16_t>{});
  EXPECT_EQ(driver.taken_back(), 3U);
  EXPECT_EQ(driver.times_off(), 1U);
}

TEST_F(ZynqmpCanTest, ABusOffThatNobodyAskedAboutIsStillTold) {
  model.error_state = 2;
  can::Frame received;
  EXPECT_FALSE(driver.receive(received, tick));
  tick += 50;
  EXPECT_FALSE(driver.receive(received, tick));
  EXPECT_TRUE(model.enabled);
  EXPECT_EQ(driver.health(tick), can::BusHealth::bus_off);
  EXPECT_EQ(driver.health(tick), can::BusHealth::active);
}

TEST_F(ZynqmpCanTest, AShortCircuitIsTriedLessAndLessOften) {
  int resets = model.resets;
  for (int times = 0; times < 6; ++times) {
    model.events |= can_bits::bus_off;
    driver.health(tick);
    for (std::uint32_t wait = 0; wait <= 2U << times; ++wait) {
      EXPECT_FALSE(model.enabled) << times << " " << wait;
      driver.health(++tick);
    }
    EXPECT_TRUE(model.enabled) << times;
    EXPECT_EQ(model.resets - resets, 2);  // off, and on again
    resets = model.resets;
  }
}

TEST_F(ZynqmpCanTest, ItsErrorCountersTellThatItIsPassive) {
  for (const std::uint32_t counters : {0x80U, 0x8000U, 0xFFU}) {
    model.error_counters = counters;
    EXPECT_EQ(driver.health(tick), can::BusHealth::error_passive);
  }
  model.error_counters = 0x7F7F;
  EXPECT_EQ(driver.health(tick), can::BusHealth::active);
}

TEST_F(ZynqmpCanTest, ItTakesWhatATickMakesWhileNobodyAcknowledges) {
  for (int i = 0; i < 9; ++i) {
    EXPECT_TRUE(driver.try_send(frame(0x100), tick));
  }
  int taken = 9;
  while (driver.try_send(frame(0x100), tick)) {
    ++taken;
  }
  EXPECT_LE(taken, 18);  // the queue's, and two in the controller
}

}  // namespace
}  // namespace striker::zcu102
