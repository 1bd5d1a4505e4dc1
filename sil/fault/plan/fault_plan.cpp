// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/plan/fault_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "firmware/can/messages.hpp"

namespace striker::sil {

std::vector<TimedFault> timed(const std::vector<Fault>& faults, std::uint32_t first_decision_tick) {
  std::vector<TimedFault> result;
  result.reserve(faults.size());
  for (const Fault& fault : faults) {
    const std::int64_t zero = fault.absolute ? 0 : first_decision_tick;
    const auto tick = [&](std::int32_t ms) {
      return static_cast<std::uint32_t>(std::max<std::int64_t>(0, zero + ms));
    };
    result.push_back({.fault = fault, .from = tick(fault.from_ms), .until = tick(fault.until_ms)});
  }
  return result;
}

Fault usual(FaultKind kind, std::int32_t from_ms, std::int32_t until_ms) {
  const FaultKindInfo& info = info_of(kind);
  return {.kind = kind,
          .from_ms = from_ms,
          .until_ms = until_ms,
          .probability = info.probability.known() ? info.probability.otherwise : 1.0,
          .count = info.count.known() ? static_cast<std::uint32_t>(info.count.otherwise) : 1,
          .value = info.value.otherwise};
}

bool possible(const Fault& fault, bool in_process) {
  const FaultKindInfo& info = info_of(fault.kind);
  const bool of_lockstep =
      fault.message == can::layout<can::Sync>.info.id || fault.message == can::layout<can::EndOfTick>.info.id;
  return in_process ? !info.real_bus : !info.in_process && !of_lockstep;
}

std::string message_name(std::uint16_t identifier) {
  std::string name = fmt::format("0x{:03x}", identifier);
  can::for_each_layout([&](const auto& message) {
    if (message.info.id == identifier) {
      name = message.info.name;
    }
  });
  return name;
}

std::optional<std::uint16_t> identifier_of(std::string_view message) {
  std::optional<std::uint16_t> identifier;
  can::for_each_layout([&](const auto& known) {
    if (known.info.name == message) {
      identifier = known.info.id;
    }
  });
  return identifier;
}

std::string in_words(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    const FaultKindInfo& info = info_of(fault.kind);
    text += fmt::format("{}{}", text.empty() ? "" : ", ", info.name);
    if (info.message != MessageParameter::none) {
      text += fmt::format(" {}", fault.message ? message_name(*fault.message) : "all");
    }
  }
  return text.empty() ? "nothing" : text;
}

}  // namespace striker::sil
