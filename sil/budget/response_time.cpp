// SPDX-License-Identifier: Apache-2.0
#include "sil/budget/response_time.hpp"

#include <algorithm>

namespace striker::sil {

namespace {

// Busy periods beyond this are called unbounded: the bus is all but full.
constexpr std::int64_t longest_busy_ns = 600'000'000'000;

constexpr std::int64_t ceil_div(std::int64_t dividend, std::int64_t divisor) {
  return (dividend + divisor - 1) / divisor;
}

std::uint32_t rank(const BusMessage& message) {
  return arbitration_rank(message.id, message.format.extended);
}

std::int64_t frames_within(std::int64_t window_ns, const BusMessage& message) {
  const std::int64_t events_ns = window_ns + message.jitter_ns;
  return std::min(ceil_div(events_ns, message.distance_ns),
                  ceil_div(events_ns, message.period_ns) + message.burst - 1);
}

// Of instance q, after the first one's.
std::int64_t earliest_event_ns(std::int64_t instance, const BusMessage& message) {
  return std::max(instance * message.distance_ns, (instance - message.burst + 1) * message.period_ns);
}

// Everything that can hold up one message.
class Level {
 public:
  Level(const std::vector<BusMessage>& messages, const BusMessage& message, const BusAssumptions& assumptions)
      : message_(message),
        assumptions_(assumptions),
        frame_ns_(longest_frame_ns(message, assumptions)),
        longest_again_ns_(frame_ns_) {
    for (const BusMessage& other : messages) {
      const std::int64_t other_ns = longest_frame_ns(other, assumptions);
      if (rank(other) > rank(message)) {
        blocking_ns_ = std::max(blocking_ns_, other_ns);
      } else if (rank(other) < rank(message)) {
        higher_.push_back({&other, other_ns});
        longest_again_ns_ = std::max(longest_again_ns_, other_ns);
      }
    }
  }

  [[nodiscard]] MessageResponse response() const {
    MessageResponse result;
    result.frame_ns = frame_ns_;
    const auto busy_ns = busy_period_ns();
    if (!busy_ns) {
      return result;
    }
    std::int64_t waiting_ns = 0;
    const std::int64_t instances = frames_within(*busy_ns, message_);
    for (std::int64_t instance = 0; instance < instances; ++instance) {
      waiting_ns = waiting_until_start_ns(instance, waiting_ns);
      const std::int64_t response_ns =
          message_.jitter_ns + waiting_ns + frame_ns_ - earliest_event_ns(instance, message_);
      if (instance == 0) {
        result.first_instance_ns = response_ns;
      }
      if (response_ns > result.response_ns.value_or(0)) {
        result.response_ns = response_ns;
        result.worst_instance = instance;
      }
    }
    return result;
  }

 private:
  struct Higher {
    const BusMessage* message;
    std::int64_t frame_ns;
  };

  [[nodiscard]] std::int64_t errors_ns(std::int64_t window_ns) const {
    if (assumptions_.error_distance_ns == 0) {
      return 0;
    }
    return (window_ns / assumptions_.error_distance_ns + 1) *
           (error_recovery_bits * assumptions_.bit_ns + longest_again_ns_);
  }

  [[nodiscard]] std::int64_t higher_ns(std::int64_t window_ns) const {
    std::int64_t sum_ns = 0;
    for (const Higher& higher : higher_) {
      sum_ns += frames_within(window_ns, *higher.message) * higher.frame_ns;
    }
    return sum_ns;
  }

  // Long-term share of the bus, errors included.
  [[nodiscard]] double load() const {
    double sum = static_cast<double>(frame_ns_) / static_cast<double>(message_.period_ns);
    for (const Higher& higher : higher_) {
      sum += static_cast<double>(higher.frame_ns) / static_cast<double>(higher.message->period_ns);
    }
    if (assumptions_.error_distance_ns != 0) {
      sum += static_cast<double>(error_recovery_bits * assumptions_.bit_ns + longest_again_ns_) /
             static_cast<double>(assumptions_.error_distance_ns);
    }
    return sum;
  }

  [[nodiscard]] std::optional<std::int64_t> busy_period_ns() const {
    if (load() >= 1.0) {
      return std::nullopt;
    }
    std::int64_t busy_ns = frame_ns_;
    while (busy_ns <= longest_busy_ns) {
      const std::int64_t next_ns = blocking_ns_ + errors_ns(busy_ns) + higher_ns(busy_ns) +
                                   frames_within(busy_ns, message_) * frame_ns_;
      if (next_ns == busy_ns) {
        return busy_ns;
      }
      busy_ns = next_ns;
    }
    return std::nullopt;
  }

  // The smallest solution; it is no less than an earlier instance's.
  [[nodiscard]] std::int64_t waiting_until_start_ns(std::int64_t instance, std::int64_t from_ns) const {
    std::int64_t waiting_ns = std::max(from_ns, blocking_ns_ + instance * frame_ns_);
    while (true) {
      const std::int64_t next_ns = blocking_ns_ + errors_ns(waiting_ns + frame_ns_) + instance * frame_ns_ +
                                   higher_ns(waiting_ns + assumptions_.bit_ns);
      if (next_ns <= waiting_ns) {
        return waiting_ns;
      }
      waiting_ns = next_ns;
    }
  }

  const BusMessage& message_;
  BusAssumptions assumptions_;
  std::int64_t frame_ns_;
  std::int64_t longest_again_ns_;
  std::int64_t blocking_ns_ = 0;
  std::vector<Higher> higher_;
};

}  // namespace

std::int64_t longest_frame_ns(const BusMessage& message, const BusAssumptions& assumptions) {
  const FrameBits bits = worst_case_frame_bits(message.bytes, message.format);
  const bool switches = message.format.bit_rate_switch && assumptions.data_bit_ns != 0;
  return bits.arbitration * assumptions.bit_ns +
         bits.data * (switches ? assumptions.data_bit_ns : assumptions.bit_ns);
}

std::vector<MessageResponse> response_times(const std::vector<BusMessage>& messages,
                                            const BusAssumptions& assumptions) {
  std::vector<MessageResponse> responses;
  responses.reserve(messages.size());
  for (const BusMessage& message : messages) {
    responses.push_back(Level(messages, message, assumptions).response());
  }
  return responses;
}

bool meets_deadline(const BusMessage& message, const MessageResponse& response) {
  return response.response_ns && *response.response_ns <= message.deadline_ns;
}

double utilisation(const std::vector<BusMessage>& messages, const BusAssumptions& assumptions) {
  double sum = 0.0;
  for (const BusMessage& message : messages) {
    sum +=
        static_cast<double>(longest_frame_ns(message, assumptions)) / static_cast<double>(message.period_ns);
  }
  return sum;
}

}  // namespace striker::sil
