// SPDX-License-Identifier: Apache-2.0
// Traffic for the bus simulation that keeps exactly what a message set promises, and what became of it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "sil/budget/response_time.hpp"
#include "sil/bus/arbitrated_bus.hpp"
#include "sil/bus/frame_bits.hpp"

namespace striker::sil {

// One frame to come: when its cause happens, and how much later it is queued.
struct Event {
  std::int64_t at_ns;
  std::int64_t delay_ns;  // up to the message's jitter
};

// Event q of a message that begins at 0 and comes as densely as it may.
inline std::int64_t densest_event_ns(const BusMessage& message, std::int64_t q) {
  return std::max({std::int64_t{0}, q * message.distance_ns, (q - message.burst + 1) * message.period_ns});
}

// The critical instant: just as the longest frame of lower priority than `victim` has begun, everything of
// its priority and above is queued, after its full jitter, and comes as densely as it may.
inline std::vector<std::vector<Event>> critical_instant(const std::vector<BusMessage>& messages,
                                                        std::size_t victim, std::int64_t bit_ns,
                                                        std::int64_t horizon_ns) {
  std::vector<std::vector<Event>> traffic(messages.size());
  const BusMessage* blocker = nullptr;
  for (std::size_t k = 0; k < messages.size(); ++k) {
    const BusMessage& message = messages[k];
    if (message.id > messages[victim].id) {
      blocker = blocker == nullptr || message.bytes > blocker->bytes ? &message : blocker;
      continue;
    }
    for (std::int64_t q = 0; densest_event_ns(message, q) - message.jitter_ns < horizon_ns; ++q) {
      const std::int64_t at_ns = densest_event_ns(message, q) - message.jitter_ns;
      traffic[k].push_back({at_ns, std::max<std::int64_t>(0, -at_ns)});
    }
  }
  if (blocker != nullptr) {
    traffic[static_cast<std::size_t>(blocker - messages.data())].push_back({-bit_ns, 0});
  }
  return traffic;
}

// The messages with identifiers of 11 bits that go in the same order.
inline std::vector<BusMessage> renumbered(std::vector<BusMessage> messages) {
  const auto rank = [](const BusMessage& message) {
    return arbitration_rank(message.id, message.format.extended);
  };
  std::vector<std::uint32_t> ranks;
  ranks.reserve(messages.size());
  for (const BusMessage& message : messages) {
    ranks.push_back(rank(message));
  }
  std::sort(ranks.begin(), ranks.end());
  for (BusMessage& message : messages) {
    const auto place = std::lower_bound(ranks.begin(), ranks.end(), rank(message));
    message.id = static_cast<std::uint32_t>(place - ranks.begin());
  }
  return messages;
}

// The longest response of each message, from the event to the end of the intermission. `bits_of` gives a
// frame's length on the wire.
inline std::vector<std::int64_t> longest_responses(
    const std::vector<BusMessage>& messages, std::int64_t bit_ns,
    const std::vector<std::vector<Event>>& traffic, const std::vector<BusError>& errors,
    const std::function<std::int64_t(const BusMessage&)>& bits_of) {
  constexpr std::int64_t ever_ns = std::int64_t{1} << 60;
  ArbitratedBus bus(bit_ns, errors);
  std::map<std::uint16_t, std::size_t> index;
  for (std::size_t k = 0; k < messages.size(); ++k) {
    const auto id = static_cast<std::uint16_t>(messages[k].id);
    index[id] = k;
    for (const Event& event : traffic[k]) {
      bus.queue({{id, static_cast<std::uint8_t>(messages[k].bytes), {}},
                 bits_of(messages[k]),
                 event.at_ns + event.delay_ns});
    }
  }
  std::vector<std::int64_t> longest(messages.size(), 0);
  std::vector<std::size_t> sent(messages.size(), 0);
  while (const auto frame = bus.next(ever_ns)) {
    const std::size_t k = index.at(frame->queued.frame.id);
    longest[k] = std::max(longest[k], frame->free_ns - traffic[k][sent[k]++].at_ns);
  }
  return longest;
}

inline std::int64_t longest_bits(const BusMessage& message) {
  return worst_case_frame_bits(message.bytes);
}

}  // namespace striker::sil
