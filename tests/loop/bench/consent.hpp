// SPDX-License-Identifier: Apache-2.0
// An operator on a test bench: sends mode commands, and confirms what the controller asks back.
#pragma once

#include <optional>
#include <span>

#include "firmware/can/codec.hpp"

namespace striker::loop {

class BenchOperator {
 public:
  [[nodiscard]] can::Frame command(can::Mode mode, std::int32_t challenge = 0) {
    return can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode), .challenge = challenge},
                     counter_);
  }

  // The confirmation of the challenge among these frames.
  [[nodiscard]] std::optional<can::Frame> answer(std::span<const can::Frame> sent) {
    for (const can::Frame& frame : sent) {
      can::Challenge challenge;
      if (can::is<can::Challenge>(frame) && can::receive(frame, challenge) == can::Verdict::accepted) {
        return command(static_cast<can::Mode>(challenge.mode), challenge.challenge);
      }
    }
    return std::nullopt;
  }

 private:
  can::SendCounter counter_;
};

}  // namespace striker::loop
