// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/link/second_controller.hpp"

#include "sil/fault/link/frame_fault.hpp"

namespace striker::sil {

namespace {

std::vector<can::Frame> heard(const std::vector<can::Frame>& others, std::span<const can::Frame> frames) {
  std::vector<can::Frame> all = others;
  all.insert(all.end(), frames.begin(), frames.end());
  return all;
}

}  // namespace

void SecondController::send(std::uint32_t tick, std::span<const can::Frame> frames) {
  if (!fault_.lasts(tick)) {
    second_.reset();
    said_by_second_.clear();
    first_->send(tick, frames);
    return;
  }
  if (!second_) {
    second_.emplace();
  }
  first_->send(tick, heard(said_by_second_, frames));
  second_->send(tick, heard(said_by_first_, frames));
}

void SecondController::collect(std::uint32_t tick, std::vector<can::Frame>& answer) {
  said_by_first_.clear();
  said_by_second_.clear();
  if (second_) {
    second_->collect(tick, said_by_second_);
    std::erase_if(said_by_second_, is_lockstep);
  }
  first_->collect(tick, said_by_first_);
  answer.insert(answer.end(), said_by_second_.begin(), said_by_second_.end());
  answer.insert(answer.end(), said_by_first_.begin(), said_by_first_.end());
}

}  // namespace striker::sil
