// SPDX-License-Identifier: Apache-2.0
// A CAN bus as a discrete-event simulation at bit-time resolution: frames wait in a queue for each identifier
// (first in, first out), the wired-AND of the identifiers' bits decides who sends, a frame that has begun
// runs to its end, and errors destroy the frame that they hit.
//
// An idle bus starts with the first frame, at once (hard synchronisation); frames queued within the first
// bit join its arbitration, as ISO 11898-1 lets them. Time is logical, in ns; a bit time is a whole number of
// ns. Two nodes never send the same identifier.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "firmware/can/frame.hpp"

namespace striker::sil {

struct QueuedFrame {
  can::Frame frame;
  std::int64_t bits = 0;  // on the wire, intermission included
  std::int64_t queued_ns = 0;
};

struct SentFrame {
  QueuedFrame queued;
  std::int64_t start_ns = 0;
  std::int64_t received_ns = 0;  // the end of its end-of-frame field: the receivers have it
  std::int64_t free_ns = 0;      // the end of the intermission: the next frame may start
};

// At `at_ns` a bit of the frame on the wire is seen wrong: it ends there, the bus is free again `bits` later,
// and its sender tries again. On an idle bus and in the intermission nothing happens.
struct BusError {
  std::int64_t at_ns = 0;
  std::int64_t bits = 0;
};

class ArbitratedBus {
 public:
  // `errors` in the order of their time.
  explicit ArbitratedBus(std::int64_t bit_ns, std::vector<BusError> errors = {});

  // Not before what `next` has returned was received, or has run to. Frames of one identifier in the order of
  // their time.
  void queue(const QueuedFrame& frame);

  // Takes back the last frame with this identifier that waits and is not on the wire. False if there is none.
  bool withdraw(std::uint16_t id);

  // The next frame that is received by `until_ns`; without one the bus has run until then.
  std::optional<SentFrame> next(std::int64_t until_ns);

  // Of all the time so far: how long the bus was not free.
  [[nodiscard]] std::int64_t busy_ns() const { return busy_ns_; }

 private:
  struct Waiting {
    std::uint16_t id;
    std::deque<QueuedFrame> frames;
  };

  [[nodiscard]] std::optional<std::int64_t> next_start() const;
  Waiting& arbitrate(std::int64_t start_ns);
  bool start_frame(std::int64_t until_ns);

  std::int64_t bit_ns_;
  std::vector<BusError> errors_;
  std::size_t next_error_ = 0;
  std::vector<Waiting> waiting_;
  std::vector<Waiting*> contenders_;
  std::optional<SentFrame> on_wire_;
  std::int64_t free_ns_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t busy_ns_ = 0;
};

}  // namespace striker::sil
