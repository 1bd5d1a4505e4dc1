// SPDX-License-Identifier: Apache-2.0
// The controller's image: the built-in node, on a board's 1 ms timer and CAN controller.
#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/clock_ticks.hpp"
#include "firmware/loop/tick_loop.hpp"
#include "firmware/ports/bare_metal/board_bus.hpp"
#include "firmware/ports/bare_metal/board_clock.hpp"

namespace {

using namespace striker;
using namespace striker::bare_metal;

using Ticks = loop::ClockTicks<BoardClock>;

// Statics, made by the compiler: the linker script knows what they take, and the stack is what it is without.
constinit BoardClock board_clock;
constinit BoardBus bus(board_clock);
constinit Ticks ticks_by_clock(board_clock, {.frames_per_tick = most_frames_a_tick, .overrun_limit = 50});
constinit loop::TickLoop<loop::BuiltInNode, BoardBus&, Ticks&> tick_loop(loop::built_in_robot, bus,
                                                                         ticks_by_clock);

}  // namespace

int main() {
  start_can();
  start_ticks();
  for (;;) {
    tick_loop.turn();
  }
}
