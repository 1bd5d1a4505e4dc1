// SPDX-License-Identifier: Apache-2.0
#include "sil/bus/arbitrated_bus.hpp"

#include <algorithm>
#include <utility>

#include "sil/bus/frame_bits.hpp"

namespace striker::sil {

ArbitratedBus::ArbitratedBus(std::int64_t bit_ns, std::vector<BusError> errors)
    : bit_ns_(bit_ns), errors_(std::move(errors)) {}

void ArbitratedBus::queue(const QueuedFrame& frame) {
  const auto same_id = [&](const Waiting& waiting) { return waiting.id == frame.frame.id; };
  auto place = std::find_if(waiting_.begin(), waiting_.end(), same_id);
  if (place == waiting_.end()) {
    place = waiting_.insert(place, Waiting{frame.frame.id, {}});
  }
  place->frames.push_back(frame);
}

bool ArbitratedBus::withdraw(std::uint16_t id) {
  for (Waiting& waiting : waiting_) {
    if (waiting.id == id && !waiting.frames.empty()) {
      waiting.frames.pop_back();
      return true;
    }
  }
  return false;
}

std::optional<std::int64_t> ArbitratedBus::next_start() const {
  std::optional<std::int64_t> earliest;
  for (const Waiting& waiting : waiting_) {
    if (!waiting.frames.empty()) {
      const std::int64_t queued_ns = waiting.frames.front().queued_ns;
      earliest = std::min(earliest.value_or(queued_ns), queued_ns);
    }
  }
  return earliest ? std::optional(std::max(*earliest, free_ns_)) : std::nullopt;
}

// Bit by bit, the highest first: who sends recessive (1) and sees dominant (0) steps back.
ArbitratedBus::Waiting& ArbitratedBus::arbitrate(std::int64_t start_ns) {
  contenders_.clear();
  for (Waiting& waiting : waiting_) {
    if (!waiting.frames.empty() && waiting.frames.front().queued_ns < start_ns + bit_ns_) {
      contenders_.push_back(&waiting);
    }
  }
  for (unsigned bit = 11; bit-- > 0;) {
    const auto recessive = [bit](const Waiting* sender) { return (sender->id >> bit & 1U) != 0; };
    if (!std::all_of(contenders_.begin(), contenders_.end(), recessive)) {
      std::erase_if(contenders_, recessive);
    }
  }
  return *contenders_.front();
}

// False if no frame can be known to start by `until_ns`.
bool ArbitratedBus::start_frame(std::int64_t until_ns) {
  const auto start_ns = next_start();
  if (!start_ns || *start_ns + bit_ns_ > until_ns) {
    return false;
  }
  Waiting& winner = arbitrate(*start_ns);
  const std::int64_t bits = winner.frames.front().bits;
  const std::int64_t received_ns = *start_ns + (bits - intermission_bits) * bit_ns_;
  while (next_error_ < errors_.size() && errors_[next_error_].at_ns <= *start_ns) {
    ++next_error_;
  }
  if (next_error_ < errors_.size() && errors_[next_error_].at_ns < received_ns) {
    const BusError& error = errors_[next_error_++];
    const std::int64_t sent_bits = (error.at_ns - *start_ns) / bit_ns_ + 1;
    free_ns_ = *start_ns + (sent_bits + error.bits) * bit_ns_;
  } else {
    free_ns_ = *start_ns + bits * bit_ns_;
    on_wire_ = SentFrame{winner.frames.front(), *start_ns, received_ns, free_ns_};
    winner.frames.pop_front();
  }
  busy_ns_ += free_ns_ - *start_ns;
  return true;
}

std::optional<SentFrame> ArbitratedBus::next(std::int64_t until_ns) {
  while (!on_wire_) {
    if (!start_frame(until_ns)) {
      return std::nullopt;
    }
  }
  return on_wire_->received_ns <= until_ns ? std::exchange(on_wire_, std::nullopt) : std::nullopt;
}

}  // namespace striker::sil
