// The controller in the simulator's own process, stepped by the same SYNC frames as over a bus. It steps
// within `send`; `collect` hands over what it said. A copy of a link is a controller of its own.
#pragma once

#include "firmware/core/sync_clock.hpp"
#include "sil/bus/controller_link.hpp"

namespace striker::sil {

class InProcessLink final : public ControllerLink {
 public:
  void send(std::uint32_t tick, std::span<const can::Frame> frames) override;
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override;

  [[nodiscard]] const core::Controller& controller() const { return clock_.controller(); }

 private:
  core::SyncClock clock_;
  core::Outputs outputs_;
};

}  // namespace striker::sil
