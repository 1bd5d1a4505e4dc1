// Runs the controller until a stop signal: in lockstep with a CAN socket's SYNC frames, or on the port's own
// 1 ms clock.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>

#include "firmware/can/messages.hpp"
#include "firmware/host/can_socket.hpp"
#include "firmware/host/periodic_clock.hpp"
#include "firmware/ports/linux/frame_bus.hpp"
#include "firmware/ports/linux/loop_timing.hpp"

namespace striker::linux_port {

// No frame but these can move the controller.
inline constexpr std::array<std::uint16_t, 6> controller_receives = {
    can::layout<can::EmergencyStop>.info.id, can::layout<can::Sync>.info.id,
    can::layout<can::ModeCommand>.info.id,   can::layout<can::WheelState>.info.id,
    can::layout<can::VisionPose>.info.id,    can::layout<can::VisionBall>.info.id};

struct LockstepReport {
  std::uint64_t ticks = 0;
  std::uint64_t dropped_frames = 0;  // that the socket did not take
};

// Without a SYNC for `sync_timeout` of wall clock, once they have begun: fault sync_lost, torque 0.
LockstepReport run_lockstep(host::CanSocket& socket, std::chrono::milliseconds sync_timeout);

struct RealTimeOptions {
  std::int64_t period_ns = host::tick_period_ns;  // of the loop; the controller takes each for 1 ms
  std::uint32_t overrun_limit = 500;
  std::uint32_t frames_per_tick = 64;  // up to greatest_frames_per_tick
  std::uint64_t ticks = 0;             // stops after these; 0: a stop signal alone stops
};

// The hard real-time loop. A tick waits for its absolute deadline, receives at most `frames_per_tick` frames
// (more wait for the next), steps, sends, and measures. Between the first deadline and the last it allocates
// nothing, takes no lock, and calls the kernel for nothing but
//
//   clock_nanosleep      once a tick
//   recvmmsg, sendmmsg   once a tick on a CAN socket; sendmmsg once more for every frame that is dropped
//
// (and clock_gettime, where the machine has no vDSO for it). Overruns: a wake-up that is late by whole
// periods skips them; they are counted, never run in a burst, and the deadlines stay on their grid. More than
// `overrun_limit` missed of the last 1,000: fault overrun, torque 0. `fault` follows the controller's, for
// another thread to tell.
void run_real_time(FrameBus& bus, host::LoopClock& clock, const RealTimeOptions& options, LoopTiming& timing,
                   std::atomic<can::Fault>& fault);

}  // namespace striker::linux_port
