// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/seat.hpp"

#include "firmware/loop/tick.hpp"

namespace striker::sil {

Seat::Seat(const SeatParts& parts) : parts_(parts) {}

void Seat::take_picture(const World& world, std::uint32_t tick, std::uint32_t latency_ticks) {
  late_.push_back({tick + latency_ticks, vision_.frames(parts_.camera.look(world))});
}

void Seat::begin_tick(std::uint32_t tick) {
  answer_.clear();
  traffic_.clear();
  for (; !late_.empty() && late_.front().tick <= tick; late_.pop_front()) {
    queued_.insert(queued_.end(), late_.front().frames.begin(), late_.front().frames.end());
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
