// SPDX-License-Identifier: Apache-2.0
// The controller in the simulator's own process, stepped by the same Sync frames as over a bus, in the same
// loop as in the firmware. It steps within `send`; `collect` hands over what it said. A copy of a link is a
// controller of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/bus.hpp"
#include "firmware/loop/sync_ticks.hpp"
#include "firmware/loop/tick_loop.hpp"
#include "sil/bus/controller_link.hpp"

namespace striker::sil {

// The loop's bus in memory: what waits for the controller, and what it sent.
class MemoryBus {
 public:
  void put(std::span<const can::Frame> frames) {
    waiting_.assign(frames.begin(), frames.end());
    taken_ = 0;
    sent_.clear();
  }
  [[nodiscard]] std::span<const can::Frame> sent() const { return sent_; }

  void poll() {}
  loop::Received<std::int64_t> receive(std::size_t most) {
    const auto frames = std::span<const can::Frame>(waiting_).subspan(taken_);
    const std::size_t count = frames.size() < most ? frames.size() : most;
    taken_ += count;
    return {.frames = frames.first(count)};
  }
  std::size_t try_send(std::span<const can::Frame> frames) {
    sent_.insert(sent_.end(), frames.begin(), frames.end());
    return frames.size();
  }
  [[nodiscard]] can::BusHealth health() const { return health_; }
  void set_health(can::BusHealth health) { health_ = health; }

 private:
  can::BusHealth health_ = can::BusHealth::active;
  std::vector<can::Frame> waiting_;
  std::size_t taken_ = 0;
  std::vector<can::Frame> sent_;
};

static_assert(loop::Bus<MemoryBus, std::int64_t>);

class InProcessLink final : public ControllerLink {
 public:
  void send(std::uint32_t tick, std::span<const can::Frame> frames) override;
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override;

  [[nodiscard]] const auto& controller() const { return loop_.node().controller(); }

  // How the controller's port finds itself on the bus. Frames pass all the same.
  void set_health(can::BusHealth health) { loop_.bus().set_health(health); }

  // The controller's node as it lies in memory: for faults of it.
  [[nodiscard]] std::span<std::byte> node_memory() {
    return std::as_writable_bytes(std::span(const_cast<loop::BuiltInNode*>(&loop_.node()), 1));
  }

 private:
  loop::TickLoop<loop::BuiltInNode, MemoryBus, loop::SyncTicks> loop_{loop::built_in_robot, {}, {}};
};

}  // namespace striker::sil
