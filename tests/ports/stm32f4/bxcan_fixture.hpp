// SPDX-License-Identifier: Apache-2.0
// The driver on the modelled controller, and time.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "firmware/ports/boards/stm32f4/bxcan.hpp"
#include "tests/ports/stm32f4/bxcan_model.hpp"

namespace striker::stm32f4 {

constexpr std::array<std::uint16_t, 10> listened = {0x010, 0x030, 0x040, 0x050, 0x060,
                                                    0x070, 0x080, 0x084, 0x088, 0x100};
constexpr std::uint32_t timing_value = 0x034D0001;
constexpr std::uint32_t recovery_bits = 128 * 11;

constexpr can::Frame frame_of(std::uint16_t id, std::uint8_t mark = 0) {
  return {.id = id, .length = 8, .data = {mark, 1, 2, 3, 4, 5, 6, 7}};
}

class BxCanBus : public ::testing::Test {
 protected:
  BxCanBus() {
    model.handler = [this] { driver.on_reception(); };
  }

  void join() {
    driver.start(timing_value, listened);
    settle();
    model.recessive_bits(11);
    settle();
    ASSERT_EQ(driver.health(now_ms), can::BusHealth::active);
  }

  void settle() {
    for (int i = 0; i < 5; ++i) {
      driver.serve(now_ms);
    }
  }

  // The next frame on the wire, and what becomes of it.
  std::optional<model::WireFrame> transmit(model::Outcome outcome = model::Outcome::acknowledged) {
    const auto frame = model.begin_transmission();
    if (frame) {
      model.end_transmission(outcome);
    }
    settle();
    return frame;
  }

  std::vector<std::uint32_t> transmitted_ids() {
    std::vector<std::uint32_t> ids;
    while (const auto frame = transmit()) {
      ids.push_back(frame->id);
    }
    return ids;
  }

  void go_bus_off() {
    ASSERT_TRUE(driver.try_send(frame_of(0x050), now_ms));
    for (int error = 0; error < 32 && !model.is_bus_off(); ++error) {
      ASSERT_TRUE(model.begin_transmission());
      model.end_transmission(model::Outcome::bit_error);
    }
    ASSERT_TRUE(model.is_bus_off());
  }

  model::BxCanModel model;
  BxCan<model::ModelledRegisters> driver{model::ModelledRegisters{&model}};
  std::uint32_t now_ms = 0;
};

}  // namespace striker::stm32f4
