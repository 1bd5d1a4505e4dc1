// SPDX-License-Identifier: Apache-2.0
// Bits of the policy's weights that flip for one controller. All controllers of a process read the same weights, so
// these are damaged while this one steps, and whole again before anybody else does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sil/bus/controller_link.hpp"
#include "sil/fault/plan/fault_plan.hpp"
#include "sil/world/random.hpp"

namespace striker::sil {

class WeightFlips final : public ControllerLink {
 public:
  // `link` is a controller's own, which steps within `send` (sil/bus/in_process_link.hpp).
  WeightFlips(ControllerLink& link, const TimedFault& fault, const Random& random)
      : link_(&link), fault_(fault), random_(random) {}

  // Throws std::runtime_error if the weights cannot be made writable.
  void send(std::uint32_t tick, std::span<const can::Frame> frames) override;
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override { link_->collect(tick, answer); }
  [[nodiscard]] std::optional<std::span<const StampedFrame>> timed_traffic() const override {
    return link_->timed_traffic();
  }

 private:
  void draw();
  void flip_all() const;

  ControllerLink* link_;
  TimedFault fault_;
  Random random_;
  std::vector<std::span<std::byte>> weights_;
  std::vector<std::uint64_t> flipped_;
};

}  // namespace striker::sil
