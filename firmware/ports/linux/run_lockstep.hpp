// SPDX-License-Identifier: Apache-2.0
// Runs a controller in lockstep with a CAN socket's Sync frames, until a stop signal.
#pragma once

#include <chrono>
#include <cstdint>

#include "firmware/host/can/can_socket.hpp"

namespace striker::linux_port {

struct LockstepReport {
  std::uint64_t ticks = 0;
  std::uint64_t dropped_frames = 0;  // that the socket did not take
};

// A socket for emergency stops alone: no other traffic stands before them, and no full queue drops them.
struct LockstepSockets {
  host::CanSocket& all_but_stops;
  host::CanSocket& stops;
};

// Without a Sync for `sync_timeout` of wall clock, once they have begun: fault sync_lost, torque 0, told again every
// 100 ms. An interface that goes away throws std::runtime_error. `seed`: core/supervision/consent.hpp.
LockstepReport run_lockstep(const LockstepSockets& sockets, std::chrono::milliseconds sync_timeout,
                            std::uint32_t seed);

}  // namespace striker::linux_port
