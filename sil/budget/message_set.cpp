// SPDX-License-Identifier: Apache-2.0
#include "sil/budget/message_set.hpp"

#include <algorithm>

#include "firmware/can/messages.hpp"

namespace striker::sil {

std::vector<BusMessage> table_messages() {
  std::vector<BusMessage> messages;
  can::for_each_layout([&](const auto& message) {
    const can::MessageInfo& info = message.info;
    const can::Traffic& traffic = info.traffic;
    if (traffic.awaited) {
      return;
    }
    const std::int64_t period_ms = info.period_ms != 0 ? info.period_ms : traffic.distance_ms;
    const std::int64_t distance_ms = traffic.distance_ms != 0 ? traffic.distance_ms : info.period_ms;
    const std::int64_t deadline_ms = traffic.deadline_ms != 0 ? traffic.deadline_ms : period_ms;
    messages.push_back({.name = std::string(info.name),
                        .sender = std::string(can::node_names[static_cast<std::size_t>(info.sender)]),
                        .id = info.id,
                        .bytes = info.length,
                        .period_ns = period_ms * ns_per_ms,
                        .distance_ns = distance_ms * ns_per_ms,
                        .burst = traffic.burst,
                        .deadline_ns = deadline_ms * ns_per_ms});
  });
  return messages;
}

const BusMessage* find_message(const std::vector<BusMessage>& messages, const std::string& name) {
  const auto found = std::find_if(messages.begin(), messages.end(),
                                  [&](const BusMessage& message) { return message.name == name; });
  return found == messages.end() ? nullptr : &*found;
}

void set_jitter(std::vector<BusMessage>& messages, const QueueingJitter& jitter) {
  const BusMessage* command = find_message(messages, std::string(can::layout<can::WheelCommand>.info.name));
  const std::string controller = command != nullptr ? command->sender : "";
  for (BusMessage& message : messages) {
    const bool is_controllers = command != nullptr && message.sender == controller;
    message.jitter_ns = is_controllers ? jitter.controller_ns : jitter.others_ns;
  }
}

}  // namespace striker::sil
