// SPDX-License-Identifier: Apache-2.0
#include "sil/bus/in_process_link.hpp"

namespace striker::sil {

void InProcessLink::send(std::uint32_t, std::span<const can::Frame> frames) {
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

void InProcessLink::collect(std::uint32_t, std::vector<can::Frame>& answer) {
  const auto sent = loop_.bus().sent();
  answer.insert(answer.end(), sent.begin(), sent.end());
}

}  // namespace striker::sil
