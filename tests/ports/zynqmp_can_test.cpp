// SPDX-License-Identifier: Apache-2.0
// The driver of the Zynq UltraScale+'s CAN controller on a model of its registers, written from AMD UG1085 and UG1087:
// FIFOs, the urgent buffer, events that are cleared by writing, configuration mode, bus-off.
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "firmware/ports/boards/zcu102-r5/zynqmp_can.hpp"

namespace striker::zcu102 {

namespace {

using Words = CanWords<Encoding::hardware>;

struct Model {
  bool enabled = false;
  int resets = 0;
  std::array<std::uint32_t, 9> filters{};  // AFR, then AFMR and AFIR of each
  std::uint32_t prescaler = 0;
  std::uint32_t segments = 0;
  std::uint32_t error_counters = 0;
  std::uint32_t error_state = 1;  // error active, outside configuration mode
  std::uint32_t events = 0;
  std::vector<std::uint32_t> fifo_words;
  std::vector<std::uint32_t> urgent_words;
  std::deque<FrameWords> fifo;
  std::optional<FrameWords> urgent;
  std::deque<FrameWords> received;
  FrameWords popped;
  std::vector<FrameWords> on_the_bus;

  // The bus takes one frame: the urgent one first.
  bool transmit() {
    if (urgent) {
      on_the_bus.push_back(*urgent);
      urgent.reset();
      return true;
    }
    if (fifo.empty()) {
      return false;
    }
    on_the_bus.push_back(fifo.front());
    fifo.pop_front();
    events |= fifo.empty() ? can_bits::transmit_empty : 0;
    return true;
  }

  void receive(const FrameWords& words) {
    received.push_back(words);
    events |= can_bits::received;
  }

  std::uint32_t status() const {
    return (enabled ? error_state << 7U : 1U) | (urgent ? can_bits::urgent_full : 0);
  }

  void reset(std::uint32_t value) {
    enabled = (value & can_bits::enable) != 0;
    if ((value & can_bits::reset) != 0) {
      Model anew;
      anew.resets = resets + 1;
      anew.on_the_bus = on_the_bus;
      *this = anew;
    }
  }

  void clear(std::uint32_t which) {
    events &= ~which;
    events |= fifo.empty() ? can_bits::transmit_empty : 0;
    events |= received.empty() ? 0 : can_bits::received;
  }
};

struct Registers {
  Model* model;

  [[nodiscard]] std::uint32_t read(CanRegister offset, std::uint32_t words = 0) const {
    switch (offset) {
      case CanRegister::status:
        return model->status();
      case CanRegister::events:
        return model->events;
      case CanRegister::error_counters:
        return model->error_counters;
      case CanRegister::receive_fifo:
        return read_frame(words);
      default:
        ADD_FAILURE() << "nobody reads " << static_cast<int>(offset);
        return 0;
    }
  }

  void write(CanRegister offset, std::uint32_t value, std::uint32_t words = 0) const {
    switch (offset) {
      case CanRegister::reset:
        model->reset(value);
        break;
      case CanRegister::mode:
        EXPECT_EQ(value, 0U);
        break;
      case CanRegister::prescaler:
        configure(model->prescaler, value);
        break;
      case CanRegister::segments:
        configure(model->segments, value);
        break;
      case CanRegister::clear_events:
        model->clear(value);
        break;
      case CanRegister::use_filters:
        configure(model->filters[0], value);
        break;
      case CanRegister::first_filter:
        configure(model->filters.at(1 + words), value);
        break;
      case CanRegister::transmit_fifo:
        put(model->fifo_words, value, words);
        break;
      case CanRegister::transmit_urgent:
        put(model->urgent_words, value, words);
        break;
      default:
        ADD_FAILURE() << "nobody writes " << static_cast<int>(offset);
    }
  }

 private:
  std::uint32_t read_frame(std::uint32_t words) const {
    if (words == 0) {
      EXPECT_FALSE(model->received.empty());
      model->popped = model->received.front();
      model->received.pop_front();
    }
    return std::array{model->popped.id, model->popped.length, model->popped.data1, model->popped.data2}.at(
        words);
  }

  void configure(std::uint32_t& place, std::uint32_t value) const {
    EXPECT_FALSE(model->enabled) << "written outside configuration mode";
    place = value;
  }

  // The last of four words hands the frame over.
  void put(std::vector<std::uint32_t>& buffer, std::uint32_t value, std::uint32_t words) const {
    EXPECT_TRUE(model->enabled);
    ASSERT_EQ(words, buffer.size());
    buffer.push_back(value);
    if (words < 3) {
      return;
    }
    const FrameWords frame = {buffer[0], buffer[1], buffer[2], buffer[3]};
    buffer.clear();
    if (&buffer == &model->urgent_words) {
      ASSERT_FALSE(model->urgent) << "the urgent buffer was full";
      model->urgent = frame;
    } else {
      model->fifo.push_back(frame);
    }
  }
};

class ZynqmpCanTest : public testing::Test {
 protected:
  ZynqmpCanTest() { driver.start(bit_timing(100'000'000), bare_metal::controller_filters<4>); }

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
    const FilterWords words = Words::encode(bare_metal::controller_filters<4>[i]);
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
  EXPECT_LE(taken, 14);
}

}  // namespace

}  // namespace striker::zcu102
