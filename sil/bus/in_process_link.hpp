// SPDX-License-Identifier: Apache-2.0
// The controller in the simulator's own process, stepped by the same Sync frames as over a bus, in the same
// loop as in the firmware. It steps within `send`; `collect` hands over what it said. A copy of a link is a
// controller of its own.
//
// A port's wall clock is counted in ticks here: without SYNC for `sync_timeout_ticks` the loop is told, and again
// every 100, as in firmware/ports/linux.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/bus.hpp"
#include "firmware/loop/ordered_node.hpp"
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
  [[nodiscard]] std::uint32_t lost() { return std::exchange(lost_, 0); }

  void set_health(can::BusHealth health) { health_ = health; }
  void lose(std::uint32_t frames) { lost_ += frames; }

 private:
  can::BusHealth health_ = can::BusHealth::active;
  std::uint32_t lost_ = 0;
  std::vector<can::Frame> waiting_;
  std::size_t taken_ = 0;
  std::vector<can::Frame> sent_;
};

static_assert(loop::Bus<MemoryBus, std::int64_t>);

template <class Node>
class NodeLink final : public ControllerLink {
 public:
  static constexpr std::uint32_t sync_timeout_ticks = 200;

  // A controller that was told of this robot.
  explicit NodeLink(const core::RobotProfile& robot) : loop_(robot, {}, {}) {}
  NodeLink() : NodeLink(loop::built_in_robot) {}

  void send(std::uint32_t, std::span<const can::Frame> frames) override {
    loop_.bus().put(frames);
    if (stands_still_) {
      return;
    }
    ++ticks_without_sync_;
    while (loop_.turn()) {
      ticks_without_sync_ = loop_.ticks().answered_sync() ? 0 : ticks_without_sync_;
    }
    constexpr std::uint32_t again_ticks = 100;
    if (ticks_without_sync_ >= sync_timeout_ticks &&
        (ticks_without_sync_ - sync_timeout_ticks) % again_ticks == 0) {
      loop_.ticks().overdue();
      loop_.turn();
    }
  }
  void collect(std::uint32_t, std::vector<can::Frame>& answer) override {
    const auto sent = loop_.bus().sent();
    answer.insert(answer.end(), sent.begin(), sent.end());
  }

  [[nodiscard]] const auto& controller() const { return loop_.node().controller(); }

  // For faults of the controller's port: its process stands still, how it finds itself on the bus (frames pass all
  // the same), and how many frames it could not keep.
  void stand_still(bool stands) { stands_still_ = stands; }
  void set_health(can::BusHealth health) { loop_.bus().set_health(health); }
  void lose(std::uint32_t frames) { loop_.bus().lose(frames); }

  // For faults of its memory: the controller's node and its command gate as they lie there.
  [[nodiscard]] std::array<std::span<std::byte>, 2> memory() {
    return {writable(loop_.node()), writable(loop_.gate())};
  }

 private:
  // The loop shows its parts as constants; it is this object's own.
  template <class Part>
  static std::span<std::byte> writable(const Part& part) {
    return std::as_writable_bytes(std::span(const_cast<Part*>(&part), 1));
  }

  loop::TickLoop<Node, MemoryBus, loop::SyncTicks> loop_;
  std::uint32_t ticks_without_sync_ = 0;
  bool stands_still_ = false;
};

// The controller that this build's programs and images run.
using InProcessLink = NodeLink<loop::BuiltInNode>;

// Compiled once, in in_process_link.cpp.
extern template class NodeLink<loop::BuiltInNode>;
extern template class NodeLink<loop::OrderedNode>;

}  // namespace striker::sil
