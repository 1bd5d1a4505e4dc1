// SPDX-License-Identifier: Apache-2.0
#include "sil/budget/budget_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "firmware/host/atomic_file.hpp"
#include "firmware/host/version.hpp"
#include "sil/bus/bit_rate.hpp"

namespace striker::sil {

namespace {

constexpr double ns_per_s = 1e9;
constexpr double longest_error_distance_ns = 1e18;  // 30 years

std::string ms(std::int64_t ns) {
  return fmt::format("{:.3f}", static_cast<double>(ns) / 1e6);
}

double us(std::int64_t ns) {
  return static_cast<double>(ns) / 1e3;
}

// Vector's names, as in VFrameFormat.
std::string format_name(const FrameFormat& format) {
  return fmt::format("{}CAN{}", format.extended ? "Extended" : "Standard", format.fd ? "_FD" : "");
}

std::string id_text(const BusMessage& message) {
  return message.format.extended ? fmt::format("0x{:08X}", message.id) : fmt::format("0x{:03X}", message.id);
}

std::size_t id_width(const BusBudget& budget) {
  const bool any_extended = std::any_of(budget.messages.begin(), budget.messages.end(),
                                        [](const BusMessage& message) { return message.format.extended; });
  return any_extended ? 11 : 6;
}

std::string row(const BusMessage& message, const MessageResponse& response, std::size_t width) {
  const bool bounded = response.response_ns.has_value();
  const std::int64_t margin_ns = message.deadline_ns - response.response_ns.value_or(0);
  return fmt::format("{:<{}} {:<16} {:>5} {:>9} {:>9} {:>5} {:>8} {:>9} {:>7} {:>9} {:>9}{}\n",
                     id_text(message), width, message.name, message.bytes, ms(message.period_ns),
                     ms(message.distance_ns), message.burst, ms(message.jitter_ns), ms(message.deadline_ns),
                     ms(response.frame_ns), bounded ? ms(*response.response_ns) : "no bound",
                     bounded ? ms(margin_ns) : "-", meets_deadline(message, response) ? "" : "  MISSED");
}

std::string decision_text(const DecisionDeadline& decision) {
  return fmt::format(
      "picture to torque command: at most {} ms = picture {} + tick phase {} + lateness {} + step {} + command {}\n",
      ms(decision.total_ns()), ms(decision.picture_ns), ms(decision.phase_ns),
      ms(decision.controller.lateness_ns), ms(decision.controller.step_ns), ms(decision.command_ns));
}

nlohmann::ordered_json row_json(const BusMessage& message, const MessageResponse& response) {
  nlohmann::ordered_json row = {{"id", message.id},
                                {"name", message.name},
                                {"sender", message.sender},
                                {"format", format_name(message.format)},
                                {"bit_rate_switch", message.format.bit_rate_switch},
                                {"bytes", message.bytes},
                                {"period_us", us(message.period_ns)},
                                {"distance_us", us(message.distance_ns)},
                                {"burst", message.burst},
                                {"jitter_us", us(message.jitter_ns)},
                                {"deadline_us", us(message.deadline_ns)},
                                {"frame_us", us(response.frame_ns)},
                                {"response_us", nullptr},
                                {"margin_us", nullptr},
                                {"meets_deadline", meets_deadline(message, response)}};
  if (response.response_ns) {
    row["response_us"] = us(*response.response_ns);
    row["margin_us"] = us(message.deadline_ns - *response.response_ns);
  }
  return row;
}

nlohmann::ordered_json decision_json(const DecisionDeadline& decision) {
  return {{"total_us", us(decision.total_ns())},        {"picture_us", us(decision.picture_ns)},
          {"phase_us", us(decision.phase_ns)},          {"lateness_us", us(decision.controller.lateness_ns)},
          {"step_us", us(decision.controller.step_ns)}, {"command_us", us(decision.command_ns)}};
}

}  // namespace

std::vector<std::string> BusBudget::missed() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    if (!meets_deadline(messages[i], responses[i])) {
      names.push_back(messages[i].name);
    }
  }
  return names;
}

std::vector<std::string> BusBudget::events_uncounted() const {
  std::vector<std::string> names;
  for (const BusMessage& message : messages) {
    if (message.events_uncounted) {
      names.push_back(message.name);
    }
  }
  return names;
}

BusAssumptions BusBudget::assumptions() const {
  const double distance_ns =
      errors_per_s > 0.0 ? std::min(ns_per_s / errors_per_s, longest_error_distance_ns) : 0.0;
  return {.bit_ns = bit_time_ns(bitrate),
          .error_distance_ns = std::llround(distance_ns),
          .data_bit_ns = data_bitrate == 0 ? 0 : bit_time_ns(data_bitrate)};
}

std::string format_table(const BusBudget& budget) {
  const std::string data_rate =
      budget.data_bitrate == 0 ? "" : fmt::format(", CAN FD data at {} bit/s", budget.data_bitrate);
  const std::size_t width = id_width(budget);
  std::string text =
      fmt::format("{} messages of {} at {} bit/s{}, {} errors/s; times in ms\n\n", budget.messages.size(),
                  budget.source, budget.bitrate, data_rate, budget.errors_per_s);
  text += fmt::format("{:<{}} {:<16} {:>5} {:>9} {:>9} {:>5} {:>8} {:>9} {:>7} {:>9} {:>9}\n", "id", width,
                      "message", "bytes", "period", "distance", "burst", "jitter", "deadline", "frame",
                      "response", "margin");
  for (std::size_t i = 0; i < budget.messages.size(); ++i) {
    text += row(budget.messages[i], budget.responses[i], width);
  }
  text += fmt::format("\nutilisation at most {:.1f} %\n",
                      100.0 * utilisation(budget.messages, budget.assumptions()));
  if (budget.decision) {
    text += decision_text(*budget.decision);
  }
  if (const auto names = budget.events_uncounted(); !names.empty()) {
    text += fmt::format("once a period, but sent on events too (give GenMsgDelayTime): {}\n",
                        fmt::join(names, ", "));
  }
  const auto missed = budget.missed();
  text += missed.empty() ? std::string("every deadline is met\n")
                         : fmt::format("deadline missed by {}\n", fmt::join(missed, ", "));
  return text;
}

void write_json(const BusBudget& budget, const std::filesystem::path& file) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < budget.messages.size(); ++i) {
    rows.push_back(row_json(budget.messages[i], budget.responses[i]));
  }
  nlohmann::ordered_json json = {{"source", budget.source},
                                 {"bitrate", budget.bitrate},
                                 {"data_bitrate", nullptr},
                                 {"errors_per_s", budget.errors_per_s},
                                 {"utilisation", utilisation(budget.messages, budget.assumptions())},
                                 {"missed", budget.missed()},
                                 {"events_uncounted", budget.events_uncounted()},
                                 {"decision", nullptr},
                                 {"messages", rows}};
  if (budget.data_bitrate != 0) {
    json["data_bitrate"] = budget.data_bitrate;
  }
  if (budget.decision) {
    json["decision"] = decision_json(*budget.decision);
  }
  host::stamp(json);
  host::AtomicFile out(file);
  out.write(json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
  out.finish();
}

}  // namespace striker::sil
