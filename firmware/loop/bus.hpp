// SPDX-License-Identifier: Apache-2.0
// The bus as the loop sees it: one of the two seams of a port (the other is the clock, clock.hpp).
//
// A port implements it as a plain class. Nothing of it blocks, allocates or throws, and one thread calls it:
//
//   poll()            called again and again while the loop waits for its tick: a port without interrupts
//                     moves here what has come into its buffer
//   receive(most)     what has come, at most `most` frames, the oldest first, and the time, on the loop's
//                     clock, at which the first of them came. More wait for the next call, but an emergency stop
//                     does not wait behind other frames. Each frame says how long it has waited (Frame::age_ms). The
//                     frames lie in the port's buffer, and stay there until the next `poll` or `receive`
//   lost()            how many frames it could not keep since it was asked last
//   try_send(frames)  offers each, in this order, and returns how many were taken. The others are lost: the
//                     next tick has newer ones, and the receivers see the gap
//   health()          whether the controller is error passive or off the bus: as of now, and off for one call at
//                     least, even if that was over by then
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/can/bus_health.hpp"
#include "firmware/can/frame.hpp"

namespace striker::loop {

template <class Time>
struct Received {
  std::span<const can::Frame> frames;
  Time oldest = 0;  // meaningless without frames
};

template <class B, class Time>
concept Bus = requires(B& bus, std::size_t most, std::span<const can::Frame> sent) {
  { bus.poll() } -> std::same_as<void>;
  { bus.receive(most) } -> std::same_as<Received<Time>>;
  { bus.try_send(sent) } -> std::same_as<std::size_t>;
  { bus.health() } -> std::same_as<can::BusHealth>;
  { bus.lost() } -> std::same_as<std::uint32_t>;
};

}  // namespace striker::loop
