// SPDX-License-Identifier: Apache-2.0
// The registers of the Zynq UltraScale+'s CAN controller, as AMD UG1085 and UG1087 have them: FIFOs, the urgent buffer, events
// that are cleared by writing, configuration mode, bus-off.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "firmware/ports/boards/zcu102-r5/zynqmp_can.hpp"

namespace striker::zcu102 {

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

}  // namespace striker::zcu102
