// SPDX-License-Identifier: Apache-2.0
// Status words as CiA 402 has them, over all of them: its table of states is written down here once more.
#include <gtest/gtest.h>

#include "firmware/can/drives/cia402_drives.hpp"

namespace striker::can::cia402 {
namespace {

TEST(StatusWord, IsReadAsTheProfileHasIt) {
  for (std::uint32_t word = 0; word <= 0xFFFFU; ++word) {
    const bool ready = (word & 1U) != 0;
    const bool on = (word & 2U) != 0;
    const bool enabled = (word & 4U) != 0;
    const bool fault = (word & 8U) != 0;
    const bool no_quick_stop = (word & 0x20U) != 0;
    const bool disabled = (word & 0x40U) != 0;
    State state = State::other;
    if (!disabled && fault && !ready && !on && !enabled) {
      state = State::fault;
    } else if (disabled && !fault && !ready && !on && !enabled) {
      state = State::switch_on_disabled;
    } else if (!disabled && !fault && no_quick_stop && ready) {
      state = !on && !enabled  ? State::ready_to_switch_on
              : on && !enabled ? State::switched_on
              : on             ? State::enabled
                               : State::other;
    }
    ASSERT_EQ(state_of(word), state) << std::hex << word;
  }
}

TEST(ControlWord, EnablesInTwoStatesAlone) {
  for (const State state : {State::other, State::fault, State::switch_on_disabled, State::ready_to_switch_on,
                            State::switched_on, State::enabled}) {
    const bool may = state == State::switched_on || state == State::enabled;
    EXPECT_EQ((control_word_after(state) & 8U) != 0, may);
  }
}

}  // namespace
}  // namespace striker::can::cia402
