// SPDX-License-Identifier: Apache-2.0
// Runs a controller in lockstep with a CAN socket's Sync frames, until a stop signal.
#pragma once

#include <chrono>
#include <cstdint>

#include "firmware/host/can_socket.hpp"

namespace striker::linux_port {

struct LockstepReport {
  std::uint64_t ticks = 0;
  std::uint64_t dropped_frames = 0;  // that the socket did not take
};

// Without a Sync for `sync_timeout` of wall clock, once they have begun: fault sync_lost, torque 0. An
// interface that goes away throws std::runtime_error.
LockstepReport run_lockstep(host::CanSocket& socket, std::chrono::milliseconds sync_timeout);

}  // namespace striker::linux_port
