// SPDX-License-Identifier: Apache-2.0
// The way to a kick run's controller: in process or over a socket, a bus in time around that if time is asked for, and what
// viewers may put on it around both.
#pragma once

#include <memory>

#include "firmware/core/robot_profile.hpp"
#include "sil/bus/in_process_link.hpp"
#include "sil/bus/timed_link.hpp"
#include "sil/fault/live_faults.hpp"
#include "sil/programs/kick_options.hpp"

namespace striker::sil {

struct KickBus {
  std::unique_ptr<InProcessLink> in_process;    // with the built-in policy; or ...
  std::unique_ptr<ControllerLink> with_policy;  // ... with the one that --policy names
  std::unique_ptr<ControllerLink> socket;
  std::unique_ptr<TimedLink> timed;
  std::unique_ptr<LiveFaults> live;  // with --view

  [[nodiscard]] ControllerLink& untimed() const {
    return in_process ? static_cast<ControllerLink&>(*in_process) : with_policy ? *with_policy : *socket;
  }
  [[nodiscard]] ControllerLink& sound() const { return timed ? *timed : untimed(); }
  [[nodiscard]] ControllerLink& link() const { return live ? *live : sound(); }
};

[[nodiscard]] KickBus open_bus(const KickOptions& options);

// That the options describe. Throws std::runtime_error that names the file.
[[nodiscard]] core::RobotDescription robot_of(const KickOptions& options);

}  // namespace striker::sil
