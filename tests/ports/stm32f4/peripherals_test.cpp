// SPDX-License-Identifier: Apache-2.0
// The STM32F4's watchdog and pins on modelled registers.
#include <gtest/gtest.h>

#include <map>

#include "firmware/ports/bare_metal/watchdog.hpp"
#include "firmware/ports/boards/stm32f4/independent_watchdog.hpp"

namespace striker::stm32f4 {

namespace {

// RM0090: prescaler and reload are written after the unlocking key alone, and arrive some of the oscillator's periods later,
// if that runs; the counter begins at what has arrived, with the feeding key.
class Watchdog {
 public:
  bool oscillator_runs = true;
  std::uint32_t reload = 0xFFF;
  std::uint32_t prescaler = 0;
  std::uint32_t fed_with = 0;
  bool runs = false;
  std::uint32_t polls = 0;
  std::uint32_t reset_flags = rcc::reset_by_watchdog;

  std::uint32_t read(std::uint32_t address) {
    if (address == rcc::control_status) {
      return reset_flags;
    }
    EXPECT_EQ(address, iwdg::status);
    ++polls;
    if (pending_ > 0 && runs && oscillator_runs && --pending_ == 0) {
      reload = new_reload_;
      prescaler = new_prescaler_;
    }
    return pending_ > 0 ? 3U : 0U;
  }

  void write(std::uint32_t address, std::uint32_t value) {
    if (address == rcc::control_status && (value & rcc::remove_reset_flags) != 0) {
      reset_flags = 0;
    } else if (address == iwdg::key) {
      runs = runs || value == iwdg::key_start;
      unlocked_ = value == iwdg::key_unlock;
      fed_with = value == iwdg::key_feed ? reload + 1 : fed_with;
    } else if (unlocked_) {
      (address == iwdg::reload ? new_reload_ : new_prescaler_) = value;
      pending_ = 5;
    }
  }

 private:
  bool unlocked_ = false;
  int pending_ = 0;
  std::uint32_t new_reload_ = 0xFFF;
  std::uint32_t new_prescaler_ = 0;
};

TEST(Stm32f4Watchdog, BitesWithinWhatABoardHasToKeepOverTheOscillatorsRange) {
  Watchdog watchdog;
  iwdg::start(watchdog, bare_metal::watchdog_timeout_ms);
  EXPECT_TRUE(watchdog.runs);
  EXPECT_EQ(watchdog.prescaler, 0U) << "4 clocks a count";
  for (const std::uint32_t hz : {17'000U, 32'000U, 47'000U}) {
    const std::uint32_t timeout_us = watchdog.fed_with * 4'000 / (hz / 1'000);
    EXPECT_GE(timeout_us, 10'000U) << hz;
    EXPECT_LE(timeout_us, 50'000U) << hz;
  }
  EXPECT_EQ(watchdog.fed_with * 4'000 / 32, 20'000U);
  EXPECT_EQ(watchdog.reset_flags, 0U) << "the next reset's cause is told, not this one's";
}

TEST(Stm32f4Watchdog, AnOscillatorThatDoesNotRunHoldsNothingUp) {
  Watchdog watchdog;
  watchdog.oscillator_runs = false;
  iwdg::start(watchdog, bare_metal::watchdog_timeout_ms);
  EXPECT_LE(watchdog.polls, iwdg::most_polls);
  EXPECT_TRUE(watchdog.runs);
}

TEST(Stm32f4Pins, GoToTheirPeripheralAndNoOtherPinChanges) {
  struct Port {
    std::map<std::uint32_t, std::uint32_t> memory;
    std::uint32_t read(std::uint32_t address) { return memory[address]; }
    void write(std::uint32_t address, std::uint32_t value) { memory[address] = value; }
  };
  for (const std::uint32_t others : {0U, 0xFFFFFFFFU}) {
    for (std::uint32_t pin = 0; pin < 16; ++pin) {
      Port port;
      for (const std::uint32_t offset : {0x00U, 0x08U, 0x0CU, 0x20U, 0x24U}) {
        port.memory[gpio::port_b + offset] = others;
      }
      give_pin_to(port, gpio::port_b, pin, 9);
      const auto expect = [&](std::uint32_t offset, std::uint32_t bits, std::uint32_t at,
                              std::uint32_t value) {
        const std::uint32_t mask = ((1U << bits) - 1) << (bits * at);
        EXPECT_EQ(port.memory[gpio::port_b + offset], (others & ~mask) | value << (bits * at)) << pin;
      };
      expect(0x00, 2, pin, 2);  // MODER: alternate function
      expect(0x08, 2, pin, 1);  // OSPEEDR: medium
      expect(0x0C, 2, pin, 1);  // PUPDR: up
      expect(pin < 8 ? 0x20 : 0x24, 4, pin % 8, 9);
      EXPECT_EQ(port.memory[gpio::port_b + (pin < 8 ? 0x24 : 0x20)], others);
    }
  }
}

}  // namespace

}  // namespace striker::stm32f4
