// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/live_faults.hpp"

#include <algorithm>

#include "sil/fault/memory/node_faults.hpp"
#include "sil/world/random_streams.hpp"

namespace striker::sil {

namespace {

// After its window a fault may still hold frames back, at most for so long.
constexpr std::uint32_t afterwards_ticks = 1'000;

}  // namespace

bool can_begin_live(FaultKind kind, bool in_process) {
  using enum FaultKind;
  const FaultKindInfo& info = info_of(kind);
  const bool is_apart = kind == masquerade || kind == emergency_stop || kind == weight_flips ||
                        kind == second_controller || kind == brown_out ||
                        info.message == MessageParameter::one;
  const bool is_of_sync = kind <= second_simulator;
  const bool is_of_link = info.place == FaultPlace::frames || info.place == FaultPlace::node;
  return is_of_link && !is_apart && !info.real_bus && (in_process || (!info.in_process && !is_of_sync));
}

bool LiveFaults::begin(FaultKind kind, std::uint32_t for_ticks) {
  if (!can_begin_live(kind, in_process_) || faults_.size() == most_at_once) {
    return false;
  }
  const TimedFault timed{
      .fault = usual(kind, 0, 0), .from = next_tick_, .until = next_tick_ + std::max(for_ticks, 1U)};
  const Random random(seed_, begun_, random_stream::faults);
  auto fault = make_frame_fault(timed, random);
  if (!fault && controller_ != nullptr) {
    fault = make_node_fault(timed, random, *controller_);
  }
  if (!fault) {
    return false;
  }
  ++begun_;
  faults_.push_back({.forgotten = timed.until + afterwards_ticks, .fault = std::move(fault)});
  return true;
}

void LiveFaults::send(std::uint32_t tick, std::span<const can::Frame> frames) {
  next_tick_ = tick + 1;
  if (faults_.empty()) {
    link_->send(tick, frames);
    return;
  }
  std::erase_if(faults_, [&](const Going& going) { return tick >= going.forgotten; });
  frames_.assign(frames.begin(), frames.end());
  for (const Going& going : faults_) {
    going.fault->to_controller(tick, frames_);
  }
  link_->send(tick, frames_);
}

void LiveFaults::collect(std::uint32_t tick, std::vector<can::Frame>& answer) {
  if (faults_.empty()) {
    link_->collect(tick, answer);
    return;
  }
  frames_.clear();
  link_->collect(tick, frames_);
  for (auto going = faults_.rbegin(); going != faults_.rend(); ++going) {
    going->fault->from_controller(tick, frames_);
  }
  answer.insert(answer.end(), frames_.begin(), frames_.end());
}

InProcessLink* controller_behind(ControllerLink& link) {
  const auto* live = dynamic_cast<LiveFaults*>(&link);
  return live != nullptr ? live->controller() : dynamic_cast<InProcessLink*>(&link);
}

}  // namespace striker::sil
