// SPDX-License-Identifier: Apache-2.0
// The messages that a bus budget is made for, from the message table; sil/budget/dbc_reader.hpp reads others.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sil/budget/response_time.hpp"

namespace striker::sil {

// Jitter 0.
[[nodiscard]] std::vector<BusMessage> table_messages();

// The message with this name, or nullptr.
[[nodiscard]] const BusMessage* find_message(const std::vector<BusMessage>& messages,
                                             const std::string& name);

// How late senders queue their frames, at most.
struct QueueingJitter {
  std::int64_t controller_ns = 0;  // lateness of the tick and the step; the controller sends `WheelCommand`
  std::int64_t others_ns = 0;
};

void set_jitter(std::vector<BusMessage>& messages, const QueueingJitter& jitter);

}  // namespace striker::sil
