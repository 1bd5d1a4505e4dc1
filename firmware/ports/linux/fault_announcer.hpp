// SPDX-License-Identifier: Apache-2.0
// Tells a changed fault on stderr.
#pragma once

#include <fmt/core.h>

#include "firmware/core/state.hpp"

namespace striker::linux_port {

class FaultAnnouncer {
 public:
  void announce(core::Fault fault) {
    if (fault == told_) {
      return;
    }
    told_ = fault;
    if (told_ == core::Fault::none) {
      fmt::print(stderr, "striker-firmware: fault cleared\n");
    } else {
      fmt::print(stderr, "striker-firmware: fault {}: torque 0\n", core::name_of(told_));
    }
  }

 private:
  core::Fault told_ = core::Fault::none;
};

}  // namespace striker::linux_port
