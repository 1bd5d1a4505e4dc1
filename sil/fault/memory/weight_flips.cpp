// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/memory/weight_flips.hpp"

#include "sil/fault/memory/bit_flips.hpp"
#include "sil/fault/memory/weights.hpp"

namespace striker::sil {

void WeightFlips::send(std::uint32_t tick, std::span<const can::Frame> frames) {
  if (!fault_.lasts(tick)) {
    link_->send(tick, frames);
    return;
  }
  if (flipped_.empty()) {
    draw();
  }
  flip_all();
  try {
    link_->send(tick, frames);
  } catch (...) {
    flip_all();
    throw;
  }
  flip_all();
}

void WeightFlips::draw() {
  weights_ = writable_weights();
  for (std::uint32_t i = 0; i < fault_.fault.count; ++i) {
    flipped_.push_back(random_.below(bits_of(weights_)));
  }
}

// Twice is not at all.
void WeightFlips::flip_all() const {
  for (const std::uint64_t bit : flipped_) {
    flip(weights_, bit);
  }
}

}  // namespace striker::sil
