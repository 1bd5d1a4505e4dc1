// SPDX-License-Identifier: Apache-2.0
// The STM32F4's CAN driver against the modelled controller: joining, receiving, sending.
#include <algorithm>
#include <random>

#include "tests/ports/stm32f4/bxcan_fixture.hpp"

namespace striker::stm32f4 {

namespace {

using can::BusHealth;
using model::Outcome;

TEST_F(BxCanBus, JoinsWhenTheInitialisationIsAcknowledgedAndTheBusWasQuiet) {
  model.acknowledges_initialisation = false;
  driver.start(timing_value, listened);
  settle();
  EXPECT_NE(model.timing(), timing_value) << "not before the acknowledge";
  EXPECT_EQ(driver.health(now_ms), BusHealth::bus_off);
  model.acknowledges_initialisation = true;
  driver.start(timing_value, listened);
  settle();
  EXPECT_EQ(model.timing(), timing_value);
  EXPECT_EQ(driver.health(now_ms), BusHealth::bus_off) << "no 11 recessive bits yet";
  EXPECT_FALSE(driver.try_send(frame_of(0x050), now_ms));
  model.recessive_bits(10);
  EXPECT_EQ(driver.health(now_ms), BusHealth::bus_off);
  model.recessive_bits(1);
  EXPECT_EQ(driver.health(now_ms), BusHealth::active);
  EXPECT_EQ(driver.bus_offs(), 0U) << "it was never off the bus, only not there yet";
}

TEST_F(BxCanBus, WhatIsRefusedWhileNotOnTheBusNeverGoes) {
  driver.start(timing_value, listened);
  EXPECT_FALSE(driver.try_send(frame_of(0x050), now_ms));
  settle();
  model.recessive_bits(11);
  settle();
  EXPECT_TRUE(transmitted_ids().empty());
}

TEST_F(BxCanBus, ExactlyTheListedStandardDataFramesPass) {
  join();
  for (std::uint32_t id = 0; id <= 0x7FF; ++id) {
    model.receive({.id = id, .is_remote = true});
    for (const std::uint32_t low : {0U, 0x3FFFFU}) {
      model.receive({.id = id << 18U | low, .is_extended = true});
    }
    can::Frame frame;
    ASSERT_FALSE(driver.receive(frame, now_ms)) << id;
    model.receive({.id = id});
    const bool is_listed = std::ranges::find(listened, id) != listened.end();
    ASSERT_EQ(driver.receive(frame, now_ms), is_listed) << id;
  }
}

TEST_F(BxCanBus, ReceivesEachByteInItsPlaceAndNoneBeyondTheLength) {
  join();
  model.receive({.id = 0x070, .length = 8, .data = {0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88}});
  model.receive({.id = 0x070, .length = 3, .data = {0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88}});
  model.receive({.id = 0x070, .length = 15, .data = {1, 2, 3, 4, 5, 6, 7, 8}});
  can::Frame frame{.age_ms = 77};
  ASSERT_TRUE(driver.receive(frame, now_ms));
  EXPECT_EQ(frame,
            (can::Frame{.id = 0x070, .length = 8, .data = {0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88}}));
  EXPECT_EQ(frame.age_ms, 0);
  ASSERT_TRUE(driver.receive(frame, now_ms));
  EXPECT_EQ(frame, (can::Frame{.id = 0x070, .length = 3, .data = {0x11, 0x22, 0x33}}));
  ASSERT_TRUE(driver.receive(frame, now_ms));
  EXPECT_EQ(frame.length, 8) << "a length code above 8 is 8 bytes";
}

// The step takes up to a tick, and a tick brings up to 24 frames.
TEST_F(BxCanBus, KeepsTheFirst32FramesInTheirOrderWhileNobodyAsks) {
  join();
  for (std::uint8_t i = 0; i < 40; ++i) {
    model.receive({.id = 0x060, .length = 1, .data = {i}});
  }
  EXPECT_EQ(model.overruns(), 0U);
  can::Frame frame;
  for (std::uint8_t i = 0; i < 32; ++i) {
    ASSERT_TRUE(driver.receive(frame, now_ms)) << int{i};
    EXPECT_EQ(frame.data[0], i);
  }
  EXPECT_FALSE(driver.receive(frame, now_ms));
  model.receive({.id = 0x060, .length = 1, .data = {99}});
  ASSERT_TRUE(driver.receive(frame, now_ms));
  EXPECT_EQ(frame.data[0], 99);
}

TEST_F(BxCanBus, WithoutItsInterruptTheControllerDropsTheNewest) {
  join();
  model.handler = nullptr;
  for (std::uint8_t i = 0; i < 5; ++i) {
    model.receive({.id = 0x060, .length = 1, .data = {i}});
  }
  EXPECT_EQ(model.overruns(), 2U);
  driver.on_reception();
  can::Frame frame;
  ASSERT_TRUE(driver.receive(frame, now_ms));
  EXPECT_EQ(frame.data[0], 0);
}

TEST_F(BxCanBus, SendsStandardDataFramesByteForByte) {
  join();
  const can::Frame sent = {.id = 0x7F0, .length = 5, .data = {0xDE, 0xAD, 0xBE, 0xEF, 0x42}};
  ASSERT_TRUE(driver.try_send(sent, now_ms));
  const auto frame = transmit();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->id, 0x7F0U);
  EXPECT_EQ(frame->length, 5U);
  EXPECT_EQ(frame->data, sent.data);
  EXPECT_FALSE(frame->is_extended || frame->is_remote);
  EXPECT_FALSE(transmit()) << "once";
}

TEST_F(BxCanBus, AMoreUrgentFrameTakesThePlaceOfTheLeastUrgent) {
  join();
  for (const int id : {0x100, 0x700, 0x110, 0x120}) {
    ASSERT_TRUE(driver.try_send(frame_of(static_cast<std::uint16_t>(id)), now_ms));
  }
  settle();
  ASSERT_TRUE(model.begin_transmission());  // 0x100 is on the wire, and three mailboxes are full
  ASSERT_TRUE(driver.try_send(frame_of(0x050), now_ms));
  settle();
  model.end_transmission(Outcome::acknowledged);
  settle();
  EXPECT_EQ(transmitted_ids(), (std::vector<std::uint32_t>{0x050, 0x110, 0x120, 0x700}));
}

TEST_F(BxCanBus, AFullQueueRefusesWhatIsNoMoreUrgentAndTakesWhatIs) {
  join();
  std::size_t taken = 0;
  while (driver.try_send(frame_of(0x110, static_cast<std::uint8_t>(taken)), now_ms)) {
    ASSERT_LT(++taken, 100U);
  }
  EXPECT_GE(taken, 9U) << "a tick's frames have room";
  EXPECT_FALSE(driver.try_send(frame_of(0x700), now_ms));
  EXPECT_TRUE(driver.try_send(frame_of(0x050), now_ms));
  EXPECT_EQ(transmit()->id, 0x050U);
  for (std::uint8_t i = 0; i + 1U < taken; ++i) {
    ASSERT_EQ(transmit()->data[0], i) << "the last one made room";
  }
  EXPECT_FALSE(transmit());
}

// Whatever is sent when, and whatever the bus does with it.
TEST_F(BxCanBus, TheWireHasTheMostUrgentFirstAndEachIdentifierInItsOrderAndOnce) {
  join();
  std::minstd_rand random(7);
  const auto draw = [&](std::uint32_t below) { return static_cast<std::uint32_t>(random() >> 4U) % below; };
  std::vector<can::Frame> waiting;  // accepted, not yet gone
  std::uint8_t mark = 0;
  std::size_t gone = 0;
  for (int turn = 0; turn < 20'000; ++turn) {
    if (draw(2) == 0 && waiting.size() < 12) {
      const can::Frame frame = frame_of(static_cast<std::uint16_t>(0x010 * (1 + draw(6))), ++mark);
      ASSERT_TRUE(driver.try_send(frame, now_ms));
      waiting.push_back(frame);
    }
    settle();
    const auto on_wire = model.begin_transmission();
    ASSERT_EQ(on_wire.has_value(), !waiting.empty());
    if (!on_wire) {
      continue;
    }
    const auto next = std::ranges::min_element(waiting, {}, &can::Frame::id);  // the first of the lowest
    ASSERT_EQ(on_wire->id, next->id);
    ASSERT_EQ(on_wire->data, next->data);
    can::Frame late;
    const bool comes_late = draw(3) == 0 && waiting.size() < 12;  // while the other is on the wire
    if (comes_late) {
      late = frame_of(static_cast<std::uint16_t>(0x010 * (1 + draw(6))), ++mark);
      ASSERT_TRUE(driver.try_send(late, now_ms));
      settle();
    }
    const bool is_acknowledged = draw(5) != 0;
    model.end_transmission(is_acknowledged ? Outcome::acknowledged : Outcome::unacknowledged);
    if (is_acknowledged) {
      waiting.erase(next);
      ++gone;
    }
    if (comes_late) {
      waiting.push_back(late);
    }
  }
  EXPECT_GT(gone, 5'000U);
}

}  // namespace

}  // namespace striker::stm32f4
