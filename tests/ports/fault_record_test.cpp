// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/bare_metal/fault_record.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/ports/bare_metal/reset.hpp"
#include "firmware/ports/bare_metal/watchdog.hpp"

extern "C" {
striker::bare_metal::KeptFault kept_fault;
}

namespace striker::bare_metal {

namespace {

struct Reset {};
struct Stopped {};

bool watchdog_reset = false;

}  // namespace

// The processor's and the board's part.
void reset_processor() {
  throw Reset();
}

void stop_processor() {
  throw Stopped();
}

bool watchdog_has_expired() {
  return watchdog_reset;
}

namespace {

constexpr FaultRecord broken = {
    .cause = FaultCause::exception, .exception = 3, .status = 0x10000, .pc = 0x1234};

class FaultRecordTest : public testing::Test {
 protected:
  FaultRecordTest() {
    kept_fault = {.magic = 0xA5A5A5A5, .record = {}, .untold = 0xA5A5A5A5, .check = 0xA5A5A5A5};
    watchdog_reset = false;
  }

  static void break_down() { EXPECT_THROW(end_by_fault(broken), Reset); }
};

TEST_F(FaultRecordTest, APowerCycleLeavesNone) {
  count_reset();
  EXPECT_EQ(take_last_fault(), std::nullopt);
}

TEST_F(FaultRecordTest, ItOutlivesTheResetAndIsToldOnce) {
  break_down();
  count_reset();
  FaultRecord told = broken;
  told.resets = 1;
  EXPECT_EQ(take_last_fault(), told);
  EXPECT_EQ(take_last_fault(), std::nullopt);
  count_reset();
  EXPECT_EQ(take_last_fault(), std::nullopt) << "after a reset by pin";
}

TEST_F(FaultRecordTest, AnyFlippedBitMakesItNone) {
  break_down();
  const KeptFault whole = kept_fault;
  for (std::size_t bit = 0; bit < 8 * sizeof whole; ++bit) {
    kept_fault = whole;
    reinterpret_cast<unsigned char*>(&kept_fault)[bit / 8] ^= static_cast<unsigned char>(1U << bit % 8);
    EXPECT_EQ(take_last_fault(), std::nullopt) << "bit " << bit;
  }
}

TEST_F(FaultRecordTest, ResetsAreCountedAcrossRunsAndBounded) {
  for (std::uint32_t resets = 1; resets < most_resets; ++resets) {
    break_down();
    EXPECT_NO_THROW(count_reset());
    EXPECT_EQ(take_last_fault()->resets, resets);
  }
  break_down();
  EXPECT_THROW(count_reset(), Stopped);
  EXPECT_THROW(count_reset(), Stopped) << "after a reset by pin";
}

TEST_F(FaultRecordTest, AWatchdogThatRaisesNoExceptionIsRecordedAtStartUp) {
  watchdog_reset = true;
  count_reset();
  EXPECT_EQ(take_last_fault()->cause, FaultCause::watchdog);
  for (std::uint32_t resets = 2; resets < most_resets; ++resets) {
    count_reset();
  }
  EXPECT_THROW(count_reset(), Stopped);
}

TEST_F(FaultRecordTest, AWatchdogThatBitesAStoppedProcessorChangesNothing) {
  for (std::uint32_t resets = 0; resets < most_resets; ++resets) {
    break_down();
  }
  watchdog_reset = true;
  EXPECT_THROW(count_reset(), Stopped);
  EXPECT_EQ(kept_fault.record.cause, FaultCause::exception);
  EXPECT_EQ(kept_fault.record.resets, most_resets);
}

}  // namespace

}  // namespace striker::bare_metal
