// SPDX-License-Identifier: Apache-2.0
// Runs a controller in lockstep with a CAN socket's Sync frames, until a stop signal.
//
//   run_lockstep<loop::BuiltInNode>(loop::built_in_robot, {socket, stops}, timeout, seed);
//   run_lockstep<loop::OrderedNode>(core::profile_of(core::goalkeeper), {socket, stops}, timeout, seed);
#pragma once

#include <chrono>
#include <cstdint>

#include "firmware/core/robot_profile.hpp"
#include "firmware/host/can/can_socket.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/ordered_node.hpp"

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
template <class Node>
LockstepReport run_lockstep(const core::RobotProfile& robot, const LockstepSockets& sockets,
                            std::chrono::milliseconds sync_timeout, std::uint32_t seed);

// Compiled once, in run_lockstep.cpp.
extern template LockstepReport run_lockstep<loop::BuiltInNode>(const core::RobotProfile&,
                                                               const LockstepSockets&,
                                                               std::chrono::milliseconds, std::uint32_t);
extern template LockstepReport run_lockstep<loop::OrderedNode>(const core::RobotProfile&,
                                                               const LockstepSockets&,
                                                               std::chrono::milliseconds, std::uint32_t);

}  // namespace striker::linux_port
