// Runs the controller on a CAN socket until a stop signal: in lockstep with the bus's SYNC frames, or on the
// port's own 1 ms clock.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "can/messages.hpp"
#include "ports/linux/can_socket.hpp"

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
LockstepReport run_lockstep(CanSocket& socket, std::chrono::milliseconds sync_timeout);

struct RealTimeReport {
  std::uint64_t ticks = 0;
  std::uint64_t missed_periods = 0;
  std::uint64_t dropped_frames = 0;
  std::int64_t lateness_max_ns = 0;
  std::int64_t lateness_sum_ns = 0;
  std::int64_t execution_max_ns = 0;
};

// More than `overrun_limit` missed periods within 1,000: fault overrun, torque 0.
RealTimeReport run_real_time(CanSocket& socket, std::uint32_t overrun_limit);

}  // namespace striker::linux_port
