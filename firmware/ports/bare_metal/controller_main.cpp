// The controller's image: the core, on a port's 1 ms timer and CAN controller.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "firmware/core/controller.hpp"
#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/clock.hpp"

namespace {

using namespace striker;
using namespace striker::bare_metal;

// More than 1 ms of a 1 Mbit/s bus holds (21 of the shortest frames).
constexpr std::size_t most_frames_a_tick = 24;

// More missed ticks than this within 1,000 latch the overrun fault.
constexpr std::uint32_t missed_tick_limit = 50;
constexpr std::uint32_t overrun_window_ticks = 1000;

constexpr std::int32_t greatest_measured = can::not_available - 1;

struct Inbox {
  std::array<can::Frame, most_frames_a_tick> frames{};
  std::size_t count = 0;
};

// Frames that find no room are dropped; the controller's receive checks see the gap.
void receive_until_next_tick(std::uint32_t tick, Inbox& inbox) {
  inbox.count = 0;
  can::Frame frame;
  while (ticks() == tick) {
    if (receive_can(frame) && inbox.count < inbox.frames.size()) {
      inbox.frames[inbox.count++] = frame;
    }
  }
}

void send_all(const core::Outputs& outputs) {
  for (const can::Frame& frame : outputs.frames()) {
    static_cast<void>(try_send_can(frame));
  }
}

// Statics: the linker script knows what they take, and the stack is what it is without them.
core::Controller controller;
core::Outputs outputs;
Inbox inbox;

}  // namespace

int main() {
  start_can();
  start_ticks();
  can::Timing timing{.execution_max_us = 0, .overruns = 0};
  std::uint32_t missed_in_window = 0;
  std::uint32_t tick = ticks();
  for (;;) {
    receive_until_next_tick(tick, inbox);
    const std::uint32_t now = ticks();
    const std::uint32_t missed = now - tick - 1;
    if (now / overrun_window_ticks != tick / overrun_window_ticks) {
      missed_in_window = 0;
    }
    tick = now;
    missed_in_window += missed;
    timing.overruns = std::min(timing.overruns + static_cast<std::int32_t>(missed), greatest_measured);
    controller.step({.tick = tick, .frames = std::span(inbox.frames).first(inbox.count), .timing = timing},
                    outputs);
    send_all(outputs);
    if (missed_in_window > missed_tick_limit && controller.fault() == can::Fault::none) {
      controller.enter_fault(can::Fault::overrun, outputs);
      send_all(outputs);
    }
    const auto execution_us = static_cast<std::int32_t>((ticks() - tick) * 1000 + since_tick_us());
    timing.execution_max_us = std::min(std::max(timing.execution_max_us, execution_us), greatest_measured);
  }
}
