// SPDX-License-Identifier: Apache-2.0
// Worst-case response times on a CAN bus, classic or FD: the corrected analysis of R. I. Davis, A. Burns, R. J.
// Bril, J. J. Lukkien, "Controller Area Network (CAN) schedulability analysis: Refuted, revisited and
// revised", Real-Time Systems 35 (2007). The analysis of 1994 looks at a message's first instance alone; a
// later one in the same busy period may be worse. For message m, with hp(m) the messages of higher priority:
//
//   C_m     the longest frame: its bits times the bit time, of CAN FD times the bit time of each part
//   B_m     the longest frame of lower priority: it cannot be interrupted
//   n_k(t)  frames of k that can be queued within t: ceil((t + J_k) / T_k)
//   E(t)    errors and what is sent again: (floor(t / T_error) + 1) times 31 bits and the longest frame of
//           hp(m) and m
//   t       the busy period: t = B_m + E(t) + sum over hp(m) and m of n_k(t) C_k
//   w_q     instance q starts: w_q = B_m + E(w_q + C_m) + q C_m + sum over hp(m) of n_k(w_q + one bit) C_k
//   R_m     the greatest of J_m + w_q + C_m - q T_m over all instances q of the busy period
//
// Messages that come on changes too have a shortest distance D <= T and a burst b, with b - 1 frames more
// than one a period: n_k(t) = min(ceil((t + J_k) / D_k), ceil((t + J_k) / T_k) + b_k - 1), and instance q
// comes no earlier than max(q D_m, (q - b_m + 1) T_m). With b = 1 this is the paper's model.
//
// A response runs from the event (`jitter` before the latest queueing) to the end of the intermission after
// the frame. Every time is a whole number of ns.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sil/bus/frame_bits.hpp"

namespace striker::sil {

inline constexpr std::int64_t ns_per_ms = 1'000'000;

struct BusMessage {
  std::string name;
  std::string sender;
  std::uint32_t id = 0;  // of 11 or 29 bits, unique among those
  std::int64_t bytes = 0;
  std::int64_t period_ns = 0;
  std::int64_t distance_ns = 0;  // 0 < distance <= period
  std::int64_t burst = 1;
  std::int64_t jitter_ns = 0;  // from the event to the queueing, at most
  std::int64_t deadline_ns = 0;
  FrameFormat format = {};
  bool events_uncounted = false;  // it comes on events too, which nothing bounds: only its period counts
};

struct BusAssumptions {
  std::int64_t bit_ns = 1000;
  std::int64_t error_distance_ns = 0;  // shortest time between two errors; 0: there are none
  std::int64_t data_bit_ns = 0;        // of the second bit rate; 0: there is none, frames do not switch
};

struct MessageResponse {
  std::int64_t frame_ns = 0;  // C
  // R. Nothing if messages up to this priority, with the errors, leave the bus no idle time: then frames may
  // wait for ever.
  std::optional<std::int64_t> response_ns;
  std::int64_t worst_instance = 0;     // q
  std::int64_t first_instance_ns = 0;  // of q = 0: the 1994 analysis
};

// C, at most.
[[nodiscard]] std::int64_t longest_frame_ns(const BusMessage& message, const BusAssumptions& assumptions);

// In the order of `messages`. The cost is up to their number squared, times the steps of the busy period.
[[nodiscard]] std::vector<MessageResponse> response_times(const std::vector<BusMessage>& messages,
                                                          const BusAssumptions& assumptions);

[[nodiscard]] bool meets_deadline(const BusMessage& message, const MessageResponse& response);

// The share of the bus's time that longest frames take, one a period, errors left out.
[[nodiscard]] double utilisation(const std::vector<BusMessage>& messages, const BusAssumptions& assumptions);

}  // namespace striker::sil
