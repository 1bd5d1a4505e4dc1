// SPDX-License-Identifier: Apache-2.0
// Where the controller's answer to a tick ends, in lockstep: with EndOfTick. This is the only place that knows.
#pragma once

#include <cstdint>

#include "firmware/can/codec.hpp"

namespace striker::sil {

enum class AnswerEnd {
  no,               // the answer goes on
  of_this_tick,     // the answer to the tick is whole
  of_another_tick,  // a late answer to an earlier tick ends here
};

[[nodiscard]] inline AnswerEnd end_of_answer(const can::Frame& frame, std::uint32_t tick) {
  if (!can::is<can::EndOfTick>(frame)) {
    return AnswerEnd::no;
  }
  can::EndOfTick end;
  const bool valid = can::receive(frame, end) == can::Verdict::accepted;
  return valid && static_cast<std::uint32_t>(end.tick) == (tick & 0x7FFFFFFFU) ? AnswerEnd::of_this_tick
                                                                               : AnswerEnd::of_another_tick;
}

}  // namespace striker::sil
