// SPDX-License-Identifier: Apache-2.0
// The controller's image for the processor in the loop: the built-in node on the board's CAN controller, with ticks that
// a simulator's SYNC frames give, as `striker-firmware --clock sync` has them on Linux. The board's own timer only tells
// that no SYNC has come for 2 s. Not to be flashed for driving: its challenges begin with seed 0, so that the same
// simulation gives the same bytes.
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/sync_ticks.hpp"
#include "firmware/loop/tick_loop.hpp"
#include "firmware/ports/bare_metal/board_ticks.hpp"
#include "firmware/ports/bare_metal/clock.hpp"
#include "firmware/ports/bare_metal/fault_record.hpp"
#include "firmware/ports/bare_metal/lockstep/lockstep_bus.hpp"
#include "firmware/ports/bare_metal/lockstep/step_cost.hpp"
#include "firmware/ports/bare_metal/watchdog.hpp"

extern "C" {
std::uint32_t greatest_step_counts = 0;
std::uint32_t dropped_frames = 0;
}

namespace {

using namespace striker;
using namespace striker::bare_metal;

constexpr std::uint32_t sync_timeout_ticks = 2'000;
constexpr std::uint32_t told_again_ticks = can::layout<can::FaultReport>.info.period_ms;

constinit LockstepBus bus;
using Ticks = MeasuredTicks<BoardTicks<loop::SyncTicks>>;
constinit Ticks board_ticks{BoardTicks<loop::SyncTicks>{loop::SyncTicks{}}};
using Loop = loop::TickLoop<loop::BuiltInNode, LockstepBus&, Ticks&>;
alignas(Loop) constinit std::array<std::byte, sizeof(Loop)> loop_memory{};

[[gnu::noinline]] Loop& make_loop() {
  return *new (loop_memory.data()) Loop(loop::built_in_robot, bus, board_ticks);
}

}  // namespace

int main() {
  Loop& tick_loop = make_loop();
  if (const auto last = take_last_fault()) {
    board_ticks.source().tell(fault_of(*last));
  }
  loop::SyncTicks& sync = board_ticks.source().source();
  start_can();
  start_ticks();
  start_cost_counter();
  start_watchdog();
  std::uint32_t last_sync = ticks();
  std::uint32_t last_told = last_sync;
  std::uint32_t last_fed = last_sync;
  for (;;) {
    if (tick_loop.turn()) {
      dropped_frames = static_cast<std::uint32_t>(tick_loop.dropped_frames());
      last_sync = sync.answered_sync() ? ticks() : last_sync;
    }
    const std::uint32_t now = ticks();
    if (now == last_fed) {
      continue;
    }
    last_fed = now;
    feed_watchdog();
    if (now - last_sync > sync_timeout_ticks && now - last_told >= told_again_ticks) {
      last_told = now;
      sync.overdue();
    }
  }
}
