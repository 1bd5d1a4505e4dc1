// SPDX-License-Identifier: Apache-2.0
// Consent in two steps: what can set the wheels free, arming and clearing, is asked for, answered by the
// controller with a challenge, and confirmed with that number. Neither random bytes, nor a frame that repeats,
// nor a recording can do that.
//
//   ask(arm)            -> challenge 0x2F61A0B3, good once and for `consent_ticks`
//   confirm(arm, 0x2F61A0B3) -> granted
//
// A new request replaces the open one, and a wrong confirmation closes it: a guess costs a request. With one open
// challenge a random 31-bit number is right with probability 2^-31.
//
// Where challenges come from. Each is the next of a sequence that the seed begins (a linear congruential state, mixed
// by the finaliser of MurmurHash3). A port draws the seed when it starts, so that no recording fits. Seed 0 is for
// simulations that have to give the same bytes again: their recordings do arm such a controller.
// Whoever can listen and send can give consent: this is no authentication.
#pragma once

#include <cstdint>

#include "firmware/core/percepts.hpp"

namespace striker::core {

inline constexpr std::uint32_t consent_ticks = 500;

// What was asked for; the challenge is never 0.
struct OpenRequest {
  Order order = Order::none;
  std::uint32_t challenge = 0;
};

class Consent {
 public:
  explicit constexpr Consent(std::uint32_t seed) : seed_(seed), sequence_(seed) {}

  // Once a tick. The order that this tick confirmed, or none.
  [[nodiscard]] Order step(std::uint32_t tick, const Requests& requests) {
    Order granted = Order::none;
    if (tick - open_tick_ > consent_ticks) {
      open_ = {};
    }
    if (requests.confirmed.order != Order::none) {
      const bool fits =
          open_.order == requests.confirmed.order && open_.challenge == requests.confirmed.challenge;
      granted = fits ? open_.order : Order::none;
      open_ = {};
    }
    if (requests.asked != Order::none) {
      open_ = {requests.asked, next_challenge()};
      open_tick_ = tick;
    }
    return granted;
  }

  // What was asked for in this tick; Order::none if nothing was.
  [[nodiscard]] OpenRequest opened_at(std::uint32_t tick) const {
    return open_tick_ == tick ? open_ : OpenRequest{};
  }
  void close() { open_ = {}; }

  // For a controller that begins anew: the challenges go on, or, with seed 0, come again.
  [[nodiscard]] std::uint32_t next_seed() const { return seed_ == 0 ? 0 : (sequence_ ^ mark) | 1U; }

 private:
  static constexpr std::uint32_t mark = 0x9E3779B9;

  std::uint32_t next_challenge() {
    sequence_ = sequence_ * 1664525U + 1013904223U;
    std::uint32_t mixed = sequence_;
    mixed = (mixed ^ mixed >> 16U) * 0x85EBCA6BU;
    mixed = (mixed ^ mixed >> 13U) * 0xC2B2AE35U;
    mixed = (mixed ^ mixed >> 16U) & 0x7FFFFFFFU;
    return mixed == 0 ? 1 : mixed;
  }

  std::uint32_t seed_;
  std::uint32_t sequence_;
  OpenRequest open_;
  std::uint32_t open_tick_ = 0;
};

}  // namespace striker::core
