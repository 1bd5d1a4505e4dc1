// SPDX-License-Identifier: Apache-2.0
#include "sil/budget/budget_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "firmware/host/atomic_file.hpp"
#include "firmware/host/version.hpp"

namespace striker::sil {

namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

std::string ms(std::int64_t ns) {
  return fmt::format("{:.3f}", static_cast<double>(ns) / 1e6);
}

double us(std::int64_t ns) {
  return static_cast<double>(ns) / 1e3;
}

std::string row(const BusMessage& message, const MessageResponse& response) {
  const bool bounded = response.response_ns.has_value();
  const std::int64_t margin_ns = message.deadline_ns - response.response_ns.value_or(0);
  return fmt::format("0x{:03X}  {:<16} {:>5} {:>9} {:>9} {:>5} {:>8} {:>9} {:>7} {:>9} {:>9}{}\n", message.id,
                     message.name, message.bytes, ms(message.period_ns), ms(message.distance_ns),
                     message.burst, ms(message.jitter_ns), ms(message.deadline_ns), ms(response.frame_ns),
                     bounded ? ms(*response.response_ns) : "no bound", bounded ? ms(margin_ns) : "-",
                     meets_deadline(message, response) ? "" : "  MISSED");
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

std::string format_table(const BusBudget& budget) {
  std::string text = fmt::format("{} messages of {} at {} bit/s, {} errors/s; times in ms\n\n",
                                 budget.messages.size(), budget.source, budget.bitrate, budget.errors_per_s);
  text += fmt::format("{:<6} {:<16} {:>5} {:>9} {:>9} {:>5} {:>8} {:>9} {:>7} {:>9} {:>9}\n", "id", "message",
                      "bytes", "period", "distance", "burst", "jitter", "deadline", "frame", "response",
                      "margin");
  for (std::size_t i = 0; i < budget.messages.size(); ++i) {
    text += row(budget.messages[i], budget.responses[i]);
  }
  text += fmt::format("\nutilisation at most {:.1f} %\n",
                      100.0 * utilisation(budget.messages, ns_per_s / budget.bitrate));
  if (budget.decision) {
    text += decision_text(*budget.decision);
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
                                 {"errors_per_s", budget.errors_per_s},
                                 {"utilisation", utilisation(budget.messages, ns_per_s / budget.bitrate)},
                                 {"missed", budget.missed()},
                                 {"decision", nullptr},
                                 {"messages", rows}};
  if (budget.decision) {
    json["decision"] = decision_json(*budget.decision);
  }
  host::stamp(json);
  host::AtomicFile out(file);
  out.write(json.dump(1) + '\n');
  out.finish();
}

}  // namespace striker::sil
