// SPDX-License-Identifier: Apache-2.0
// A link whose frames pass faults, and a link that shows what passed it: decorators of any other link.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sil/bus/controller_link.hpp"
#include "sil/fault/link/frame_fault.hpp"

namespace striker::sil {

// On the way to the controller the first fault comes first, on the way back the last one.
class LinkFaults final : public ControllerLink {
 public:
  LinkFaults(ControllerLink& link, std::vector<std::unique_ptr<FrameFault>> faults)
      : link_(&link), faults_(std::move(faults)) {}

  void send(std::uint32_t tick, std::span<const can::Frame> frames) override {
    frames_.assign(frames.begin(), frames.end());
    for (const auto& fault : faults_) {
      fault->to_controller(tick, frames_);
    }
    link_->send(tick, frames_);
  }

  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override {
    frames_.clear();
    link_->collect(tick, frames_);
    for (auto fault = faults_.rbegin(); fault != faults_.rend(); ++fault) {
      (*fault)->from_controller(tick, frames_);
    }
    answer.insert(answer.end(), frames_.begin(), frames_.end());
  }

  [[nodiscard]] std::optional<std::span<const StampedFrame>> timed_traffic() const override {
    return link_->timed_traffic();
  }

 private:
  ControllerLink* link_;
  std::vector<std::unique_ptr<FrameFault>> faults_;
  std::vector<can::Frame> frames_;
};

// Keeps what passed in the last tick.
class LinkTap final : public ControllerLink {
 public:
  explicit LinkTap(ControllerLink& link) : link_(&link) {}

  void send(std::uint32_t tick, std::span<const can::Frame> frames) override {
    to_controller_.assign(frames.begin(), frames.end());
    from_controller_.clear();
    link_->send(tick, frames);
  }

  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override {
    link_->collect(tick, from_controller_);
    answer.insert(answer.end(), from_controller_.begin(), from_controller_.end());
  }

  [[nodiscard]] std::optional<std::span<const StampedFrame>> timed_traffic() const override {
    return link_->timed_traffic();
  }

  [[nodiscard]] std::span<const can::Frame> to_controller() const { return to_controller_; }
  [[nodiscard]] std::span<const can::Frame> from_controller() const { return from_controller_; }

 private:
  ControllerLink* link_;
  std::vector<can::Frame> to_controller_;
  std::vector<can::Frame> from_controller_;
};

}  // namespace striker::sil
