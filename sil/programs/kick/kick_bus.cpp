// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/kick/kick_bus.hpp"

#include <chrono>
#include <cmath>
#include <string>

#include "sil/bus/bit_rate.hpp"
#include "sil/bus/socketcan_link.hpp"
#include "sil/policy/loaded_pilot.hpp"
#include "sil/programs/robot_options.hpp"

namespace striker::sil {

core::RobotDescription robot_of(const KickOptions& options) {
  return described_robot(options.robot, options.policy.empty() ? nullptr : LoadedPilot::suits);
}

KickBus open_bus(const KickOptions& options) {
  KickBus bus;
  const std::string interface = interface_of(options.bus);
  if (!options.policy.empty()) {
    bus.with_policy = std::make_unique<NodeLink<LoadedNode>>(core::profile_of(robot_of(options)));
  } else if (options.in_process()) {
    bus.in_process = std::make_unique<InProcessLink>(core::profile_of(robot_of(options)));
  } else if (options.real_time) {
    bus.socket = std::make_unique<FreeRunningLink>(interface);
  } else {
    bus.socket = std::make_unique<LockstepLink>(
        interface, SocketCanOptions{std::chrono::milliseconds(options.answer_timeout_ms),
                                    std::chrono::milliseconds(options.start_timeout_ms)});
  }
  if (options.bitrate != 0) {
    bus.timed = std::make_unique<TimedLink>(
        bus.untimed(), TimedBusOptions{.bit_ns = bit_time_ns(options.bitrate),
                                       .step_ns = std::llround(options.step_us * 1e3),
                                       .vision_phase_ns = std::llround(options.vision_phase_us * 1e3)});
  }
  if (options.view.port) {
    bus.live =
        std::make_unique<LiveFaults>(bus.sound(), bus.in_process.get(), options.in_process(), options.seed);
  }
  return bus;
}

}  // namespace striker::sil
