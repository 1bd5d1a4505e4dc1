// SPDX-License-Identifier: Apache-2.0
// A link on which frames get lost, and behind which the controller may die and come back: a decorator of any
// other link.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "sil/bus/controller_link.hpp"

namespace striker::sil {

// From tick `from` on, until the tick before `until`.
struct LinkFault {
  std::uint32_t from = 0;
  std::uint32_t until = 0;
  // Frames with this identifier are lost, in both directions. Nothing: the controller is dead. It gets no
  // frame, SYNC included, and is not waited for.
  std::optional<std::uint16_t> lost_identifier = {};
};

class FaultyLink final : public ControllerLink {
 public:
  // `power_on` is called when a dead controller comes back, before its first frame: it may boot it anew.
  FaultyLink(ControllerLink& link, std::vector<LinkFault> faults, std::function<void()> power_on = {});

  void send(std::uint32_t tick, std::span<const can::Frame> frames) override;
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override;
  [[nodiscard]] std::optional<std::span<const StampedFrame>> timed_traffic() const override;

 private:
  [[nodiscard]] bool dead(std::uint32_t tick) const;
  [[nodiscard]] bool loses(const can::Frame& frame, std::uint32_t tick) const;

  ControllerLink* link_;
  std::vector<LinkFault> faults_;
  std::function<void()> power_on_;
  bool was_dead_ = false;
  std::vector<can::Frame> kept_;
};

}  // namespace striker::sil
