// SPDX-License-Identifier: Apache-2.0
#include "sil/budget/decision_deadline.hpp"

#include <algorithm>

#include "firmware/can/messages.hpp"
#include "sil/budget/message_set.hpp"

namespace striker::sil {

namespace {

template <class Message>
std::optional<std::size_t> index_of(const std::vector<BusMessage>& messages) {
  const BusMessage* found = find_message(messages, std::string(can::layout<Message>.info.name));
  return found == nullptr ? std::nullopt : std::optional(static_cast<std::size_t>(found - messages.data()));
}

}  // namespace

std::optional<DecisionDeadline> decision_deadline(const std::vector<BusMessage>& messages,
                                                  const std::vector<MessageResponse>& responses,
                                                  const ControllerTime& controller) {
  const auto pose = index_of<can::VisionPose>(messages);
  const auto ball = index_of<can::VisionBall>(messages);
  const auto command = index_of<can::WheelCommand>(messages);
  if (!pose || !ball || !command) {
    return std::nullopt;
  }
  const auto pose_ns = responses[*pose].response_ns;
  const auto ball_ns = responses[*ball].response_ns;
  const auto command_ns = responses[*command].response_ns;
  if (!pose_ns || !ball_ns || !command_ns) {
    return std::nullopt;
  }
  return DecisionDeadline{.picture_ns = std::max(*pose_ns, *ball_ns),
                          .controller = controller,
                          .command_ns = *command_ns - messages[*command].jitter_ns};
}

std::optional<std::int64_t> sync_lateness_ns(std::vector<BusMessage> messages,
                                             const BusAssumptions& assumptions, std::int64_t others_ns) {
  const auto sync = index_of<can::Sync>(messages);
  if (!sync) {
    return std::nullopt;
  }
  // Of the controller's frames FaultReport alone goes before Sync; it answers an earlier Sync, up to a tick
  // late.
  set_jitter(messages, {.controller_ns = loop::tick_period_ns, .others_ns = others_ns});
  return response_times(messages, assumptions)[*sync].response_ns;
}

}  // namespace striker::sil
