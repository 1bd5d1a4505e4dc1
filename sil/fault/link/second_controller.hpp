// SPDX-License-Identifier: Apache-2.0
// Two controllers with one identity on a bus: a decorator of the link to the first. Both get every frame, the
// drives hear both, and each hears in the next tick what the other said.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sil/bus/in_process_link.hpp"
#include "sil/fault/plan/fault_plan.hpp"

namespace striker::sil {

class SecondController final : public ControllerLink {
 public:
  SecondController(ControllerLink& first, const TimedFault& fault) : first_(&first), fault_(fault) {}

  void send(std::uint32_t tick, std::span<const can::Frame> frames) override;
  // The second one's answer comes before the first one's, so that EndOfTick is still the last.
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override;

 private:
  ControllerLink* first_;
  TimedFault fault_;
  std::optional<InProcessLink> second_;  // from the window's first tick to its last
  std::vector<can::Frame> said_by_first_;
  std::vector<can::Frame> said_by_second_;
};

}  // namespace striker::sil
