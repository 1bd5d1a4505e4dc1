// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/seat.hpp"

#include <algorithm>

#include "firmware/loop/tick.hpp"

namespace striker::sil {

Seat::Seat(const SeatParts& parts) : parts_(parts) {}

void Seat::take_picture(const World& world, std::uint32_t tick, std::uint32_t latency_ticks) {
  const Late late{tick + latency_ticks, parts_.camera.look(world)};
  const auto leaves_sooner = [](const Late& one, const Late& other) { return one.tick < other.tick; };
  late_.insert(std::upper_bound(late_.begin(), late_.end(), late, leaves_sooner), late);
}

void Seat::begin_tick(std::uint32_t tick) {
  answer_.clear();
  traffic_.clear();
  for (; !late_.empty() && late_.front().tick <= tick; late_.pop_front()) {
    const auto frames = vision_.frames(late_.front().picture);
    queued_.insert(queued_.end(), frames.begin(), frames.end());
  }
  if (tick != 0) {
    parts_.drives.report(parts_.plant.measured(), tick, queued_);
  }
  if (parts_.lockstep) {
    queue(can::send(can::Sync{.tick = static_cast<std::int32_t>(tick)}, sync_counter_));
  }
  for (const can::Frame& frame : queued_) {
    traffic_.push_back({frame, tick * loop::tick_period_ns});
  }
  parts_.link.send(tick, queued_);
  queued_.clear();
}

void Seat::end_tick(std::uint32_t tick) {
  parts_.link.collect(tick, answer_);
  for (const can::Frame& frame : answer_) {
    parts_.drives.take(frame, tick);
    traffic_.push_back({frame, tick * loop::tick_period_ns});
  }
}

void Seat::actuate(World& world, std::uint32_t tick) {
  parts_.plant.actuate(world, parts_.drives.orders(), parts_.drives.cut(tick));
}

std::span<const StampedFrame> Seat::traffic() const {
  return parts_.link.timed_traffic().value_or(traffic_);
}

}  // namespace striker::sil
