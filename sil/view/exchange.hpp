// SPDX-License-Identifier: Apache-2.0
// All that a run and its server of the live view have in common: two threads, and neither waits for the other.
//
//   run      every tick: takes commands, and shows its state if it was asked to
//   server   some 30 times a second of wall time: asks for a state and takes the latest
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "sil/view/command.hpp"
#include "sil/view/latest.hpp"
#include "sil/view/live_state.hpp"

namespace striker::sil {

// Commands from the server to the run, in their order: one thread puts, one takes.
class CommandQueue {
 public:
  // False, and nothing was put, while the run has not taken those before.
  [[nodiscard]] bool put(const ViewCommand& command) {
    const std::uint32_t put = put_.load(std::memory_order_relaxed);
    if (put - taken_.load(std::memory_order_acquire) == commands_.size()) {
      return false;
    }
    commands_[put % commands_.size()] = command;
    put_.store(put + 1, std::memory_order_release);
    return true;
  }
  [[nodiscard]] std::optional<ViewCommand> take() {
    const std::uint32_t taken = taken_.load(std::memory_order_relaxed);
    if (taken == put_.load(std::memory_order_acquire)) {
      return std::nullopt;
    }
    const ViewCommand command = commands_[taken % commands_.size()];
    taken_.store(taken + 1, std::memory_order_release);
    return command;
  }

 private:
  std::array<ViewCommand, 64> commands_ = {};
  alignas(64) std::atomic<std::uint32_t> put_ = 0;
  alignas(64) std::atomic<std::uint32_t> taken_ = 0;
};

struct ViewExchange {
  Latest<LiveState> states;
  CommandQueue commands;
  alignas(64) std::atomic<bool> wanted = false;  // a state is asked for; the run answers after its next tick
};

}  // namespace striker::sil
