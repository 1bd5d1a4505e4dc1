// SPDX-License-Identifier: Apache-2.0
// The controller's image: the built-in node, on a board's 1 ms timer and CAN controller.
#include <array>
#include <cstddef>
#include <new>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/clock_ticks.hpp"
#include "firmware/loop/tick_loop.hpp"
#include "firmware/ports/bare_metal/board_bus.hpp"
#include "firmware/ports/bare_metal/board_clock.hpp"
#include "firmware/ports/bare_metal/board_ticks.hpp"
#include "firmware/ports/bare_metal/fault_record.hpp"
#include "firmware/ports/bare_metal/memory.hpp"
#include "firmware/ports/bare_metal/watchdog.hpp"

namespace {

using namespace striker;
using namespace striker::bare_metal;

// Statics: the linker script knows what they take, and the stack is what it is without. The loop is made at the start of
// `main`: nearly all of it begins as 0, and its image would take as much flash as the memory that it fills.
constinit BoardClock board_clock;
constinit BoardBus bus(board_clock);
using Ticks = BoardTicks<loop::ClockTicks<BoardClock>>;
constinit Ticks board_ticks({board_clock, {.frames_per_tick = most_frames_a_tick, .overrun_limit = 50}});
using Loop = loop::TickLoop<loop::BuiltInNode, BoardBus&, Ticks&>;
alignas(Loop) constinit std::array<std::byte, sizeof(Loop)> loop_memory{};

// Apart from `main`, whose stack lasts.
[[gnu::noinline]] Loop& make_loop() {
  return *new (loop_memory.data()) Loop(loop::built_in_robot, bus, board_ticks);
}

}  // namespace

int main() {
  Loop& tick_loop = make_loop();
  if (const auto last = take_last_fault()) {
    board_ticks.tell(fault_of(*last));
  }
  tick_loop.seed_challenges(power_on_noise());
  start_can();
  start_ticks();
  start_watchdog();
  for (;;) {
    if (tick_loop.turn()) {
      feed_watchdog();
    }
  }
}
