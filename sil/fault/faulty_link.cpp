// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/faulty_link.hpp"

#include <algorithm>
#include <utility>

namespace striker::sil {

namespace {

bool lasts(const LinkFault& fault, std::uint32_t tick) {
  return tick >= fault.from && tick < fault.until;
}

}  // namespace

FaultyLink::FaultyLink(ControllerLink& link, std::vector<LinkFault> faults, std::function<void()> power_on)
    : link_(&link), faults_(std::move(faults)), power_on_(std::move(power_on)) {}

void FaultyLink::send(std::uint32_t tick, std::span<const can::Frame> frames) {
  const bool is_dead = dead(tick);
  if (std::exchange(was_dead_, is_dead) && !is_dead && power_on_) {
    power_on_();
  }
  if (is_dead) {
    return;
  }
  kept_.assign(frames.begin(), frames.end());
  std::erase_if(kept_, [&](const can::Frame& frame) { return loses(frame, tick); });
  link_->send(tick, kept_);
}

void FaultyLink::collect(std::uint32_t tick, std::vector<can::Frame>& answer) {
  if (dead(tick)) {
    return;
  }
  const auto begin = static_cast<std::ptrdiff_t>(answer.size());
  link_->collect(tick, answer);
  answer.erase(std::remove_if(answer.begin() + begin, answer.end(),
                              [&](const can::Frame& frame) { return loses(frame, tick); }),
               answer.end());
}

// A bus that was not run in this tick still shows the tick before.
std::optional<std::span<const StampedFrame>> FaultyLink::timed_traffic() const {
  const auto traffic = link_->timed_traffic();
  return traffic && was_dead_ ? std::span<const StampedFrame>() : traffic;
}

bool FaultyLink::dead(std::uint32_t tick) const {
  return std::any_of(faults_.begin(), faults_.end(),
                     [&](const LinkFault& fault) { return lasts(fault, tick) && !fault.lost_identifier; });
}

bool FaultyLink::loses(const can::Frame& frame, std::uint32_t tick) const {
  return std::any_of(faults_.begin(), faults_.end(), [&](const LinkFault& fault) {
    return lasts(fault, tick) && fault.lost_identifier == frame.id;
  });
}

}  // namespace striker::sil
