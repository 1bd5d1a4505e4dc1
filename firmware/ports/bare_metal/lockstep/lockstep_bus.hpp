// SPDX-License-Identifier: Apache-2.0
// The board's CAN controller in lockstep: a frame at a time, as SyncTicks takes them, and patience where a queue is
// full, since the simulator waits for every frame of an answer. A frame is as old as logical time says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/can/frame.hpp"
#include "firmware/loop/bus.hpp"
#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/clock.hpp"
#include "firmware/ports/bare_metal/watchdog.hpp"

namespace striker::bare_metal {

class LockstepBus {
 public:
  void poll() {}

  loop::Received<std::int32_t> receive(std::size_t) {
    const bool has_come = receive_can(frame_);
    frame_.age_ms = 0;
    return {.frames = std::span(&frame_, has_come ? 1 : 0)};
  }

  std::size_t try_send(std::span<const can::Frame> frames) {
    const std::uint32_t begin = ticks();
    std::size_t taken = 0;
    for (const can::Frame& frame : frames) {
      bool is_taken = try_send_can(frame);
      while (!is_taken && ticks() - begin < patience_ticks && can_health() != can::BusHealth::bus_off) {
        feed_watchdog();
        is_taken = try_send_can(frame);
      }
      taken += is_taken ? 1 : 0;
    }
    return taken;
  }

  [[nodiscard]] can::BusHealth health() const { return can_health(); }
  [[nodiscard]] std::uint32_t lost() const { return 0; }

 private:
  static constexpr std::uint32_t patience_ticks = 500;  // for all of a tick's frames

  can::Frame frame_;
};

static_assert(loop::Bus<LockstepBus, std::int32_t>);

}  // namespace striker::bare_metal
