// SPDX-License-Identifier: Apache-2.0
#include "sil/bus/in_process_link.hpp"

namespace striker::sil {

void InProcessLink::send(std::uint32_t, std::span<const can::Frame> frames) {
  loop_.bus().put(frames);
  while (loop_.turn()) {
  }
}

void InProcessLink::collect(std::uint32_t, std::vector<can::Frame>& answer) {
  const auto sent = loop_.bus().sent();
  answer.insert(answer.end(), sent.begin(), sent.end());
}

}  // namespace striker::sil
