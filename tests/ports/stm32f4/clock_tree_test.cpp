// SPDX-License-Identifier: Apache-2.0
// The STM32F4's clock set-up on modelled registers: in the order that the hardware needs, and never without an end.
#include "firmware/ports/boards/stm32f4/clock_tree.hpp"

#include <gtest/gtest.h>

#include <map>

namespace striker::stm32f4 {

namespace {

using namespace clock_bits;

constexpr ClockTree tree = {.crystal_hz = 8'000'000, .crystal_is_clock = false, .system_hz = 160'000'000};
static_assert(tree.is_possible() && tree.apb1_hz() == 40'000'000 && tree.wait_states() == 5);
static_assert(ClockTree{25'000'000, false, 168'000'000}.is_possible());
static_assert(!ClockTree{8'000'000, false, 180'000'000}.is_possible(), "needs the F446's over-drive");
static_assert(!ClockTree{32'768, false, 160'000'000}.is_possible());

// What starts does so after some polls; what is broken never does.
class Clocks {
 public:
  std::uint32_t broken = 0;  // of the ready bits
  bool flash_is_broken = false;
  bool switch_is_broken = false;
  std::uint32_t polls = 0;
  bool bypass_was_set = false;

  std::map<std::uint32_t, std::uint32_t> memory = {
      {rcc::control, 0x83}, {rcc::pll, 0x24003010}, {rcc::configuration, 0}, {flash_access, 0}};

  std::uint32_t read(std::uint32_t address) {
    ++polls;
    if (address == rcc::control) {
      for (const std::uint32_t on : {rc_on, crystal_on, pll_on}) {
        const std::uint32_t ready = on << 1U;
        const bool runs = (memory[address] & on) != 0 && (broken & ready) == 0 && ++running_[on] > 3;
        running_[on] = (memory[address] & on) != 0 ? running_[on] : 0;
        memory[address] = (memory[address] & ~ready) | (runs ? ready : 0);
      }
    }
    if (address == rcc::configuration && !switch_is_broken) {
      memory[address] = (memory[address] & ~source_in_use) | (memory[address] & source) << 2U;
    }
    return memory[address];
  }

  void write(std::uint32_t address, std::uint32_t value) {
    const std::uint32_t control = memory[rcc::control];
    if (address == rcc::pll) {
      EXPECT_EQ(control & pll_on, 0U) << "the PLL's settings are changed while it runs";
    }
    if (address == rcc::control && ((value ^ control) & crystal_bypass) != 0) {
      EXPECT_EQ(control & crystal_on, 0U) << "bypass is changed while the crystal is on";
      bypass_was_set = (value & crystal_bypass) != 0;
    }
    if (address == rcc::control && (value & pll_on) == 0) {
      EXPECT_NE(memory[rcc::configuration] & source_in_use, pll_in_use)
          << "the PLL stops under the processor";
    }
    if (address == rcc::configuration && (value & source) == source_is_pll) {
      EXPECT_TRUE((control & pll_ready) != 0) << "the PLL is not ready";
      EXPECT_EQ(memory[flash_access] & flash_latency, tree.wait_states()) << "flash would be read too fast";
      EXPECT_EQ(value & prescalers, apb1_by_4 | apb2_by_2) << "APB would be too fast";
    }
    if (address != flash_access || !flash_is_broken) {
      memory[address] = value;
    }
  }

  // By the registers, of the processor.
  [[nodiscard]] std::uint32_t system_hz(std::uint32_t crystal_hz) {
    if ((read(rcc::configuration) & source_in_use) != pll_in_use) {
      return 16'000'000;
    }
    const std::uint32_t pll = memory[rcc::pll];
    EXPECT_TRUE((pll & pll_from_crystal) != 0);
    const std::uint32_t divider = pll & 0x3FU;
    const std::uint32_t multiplier = pll >> 6U & 0x1FFU;
    const std::uint32_t output = 2 * ((pll >> 16U & 3U) + 1);
    EXPECT_LE(crystal_hz / divider * multiplier / (pll >> 24U & 0xFU), 48'000'000U);
    return crystal_hz / divider * multiplier / output;
  }

 private:
  std::map<std::uint32_t, int> running_;
};

TEST(Stm32f4Clock, RunsFromThePllAtTheBoardsFrequency) {
  for (const std::uint32_t crystal_mhz : {4U, 8U, 12U, 16U, 25U, 26U}) {
    const ClockTree other = {crystal_mhz * 1'000'000, crystal_mhz == 12, 160'000'000};
    Clocks clocks;
    EXPECT_TRUE(start_clock(clocks, other));
    EXPECT_EQ(clocks.system_hz(other.crystal_hz), other.system_hz) << crystal_mhz;
    EXPECT_EQ(clocks.bypass_was_set, other.crystal_is_clock);
    EXPECT_NE(clocks.memory[rcc::control] & security, 0U) << "a crystal that stops is noticed";
  }
}

TEST(Stm32f4Clock, TakesOverFromABootLoaderThatRanFromThePll) {
  Clocks clocks;
  ASSERT_TRUE(
      start_clock(clocks, {.crystal_hz = 8'000'000, .crystal_is_clock = true, .system_hz = 160'000'000}));
  EXPECT_TRUE(start_clock(clocks, tree));
  EXPECT_EQ(clocks.system_hz(tree.crystal_hz), tree.system_hz);
}

TEST(Stm32f4Clock, AClockThatDoesNotStartEndsInTimeWithoutTheSwitch) {
  for (const std::uint32_t ready : {rc_ready, crystal_ready, pll_ready}) {
    Clocks clocks;
    clocks.broken = ready;
    EXPECT_FALSE(start_clock(clocks, tree));
    EXPECT_LT(clocks.polls, 2 * most_polls);
    EXPECT_EQ(clocks.system_hz(tree.crystal_hz), 16'000'000U);
  }
  Clocks slow_flash;
  slow_flash.flash_is_broken = true;
  EXPECT_FALSE(start_clock(slow_flash, tree));
  EXPECT_EQ(slow_flash.system_hz(tree.crystal_hz), 16'000'000U);
  Clocks stuck;
  stuck.switch_is_broken = true;
  EXPECT_FALSE(start_clock(stuck, tree));
  EXPECT_LT(stuck.polls, 2 * most_polls);
}

}  // namespace

}  // namespace striker::stm32f4
