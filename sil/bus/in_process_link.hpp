// The controller in the simulator's own process, stepped by the same SYNC frames as over a bus.
#pragma once

#include "firmware/core/sync_clock.hpp"
#include "sil/bus/controller_link.hpp"

namespace striker::sil {

class InProcessLink final : public ControllerLink {
 public:
  void exchange(std::uint32_t tick, std::span<const can::Frame> sent,
                std::vector<can::Frame>& answer) override;

  [[nodiscard]] const core::Controller& controller() const { return clock_.controller(); }

 private:
  core::SyncClock clock_;
  core::Outputs outputs_;
};

}  // namespace striker::sil
