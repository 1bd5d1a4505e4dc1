// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/fault_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "firmware/host/atomic_file.hpp"
#include "firmware/host/version.hpp"

namespace striker::sil {

namespace {

void add_to_list(std::string& list, const std::string& entry) {
  if (!entry.empty() && list.find(entry) == std::string::npos) {
    list += fmt::format("{}{}", list.empty() ? "" : " / ", entry);
  }
}

void keep_longest(std::optional<std::uint32_t>& longest, const std::optional<std::uint32_t>& one) {
  if (one) {
    longest = std::max(longest.value_or(0), *one);
  }
}

template <class Value>
std::string cell(const std::optional<Value>& value, const char* form) {
  return value ? fmt::format(fmt::runtime(form), *value) : "-";
}

template <class Value>
nlohmann::ordered_json json_of(const std::optional<Value>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json row_json(const FaultRow& row, const std::vector<FaultResult>& results) {
  nlohmann::ordered_json episodes = nlohmann::ordered_json::array();
  for (const FaultResult& result : results) {
    episodes.push_back(nlohmann::ordered_json::parse(to_line(result)));
  }
  return {{"name", row.name},
          {"faults", row.faults},
          {"detected_by", row.detected_by},
          {"detected_ms", json_of(row.detected_ms)},
          {"zero_torque_ms", json_of(row.zero_torque_ms)},
          {"outcome", row.outcome},
          {"reward_kept_percent", json_of(row.reward_kept_percent)},
          {"violations", row.violations},
          {"episodes", std::move(episodes)}};
}

}  // namespace

FaultRow row_of(const FaultCase& faults, const std::vector<FaultResult>& results) {
  FaultRow row;
  row.name = faults.name;
  row.faults = in_words(faults.faults);
  double reward = 0.0;
  double undisturbed = 0.0;
  for (const FaultResult& result : results) {
    add_to_list(row.detected_by, result.detected_by);
    add_to_list(row.outcome, result.failure.empty()
                                 ? std::string(fault_outcome_names[static_cast<std::size_t>(result.outcome)])
                                 : result.failure);
    keep_longest(row.detected_ms, result.detected_ms);
    keep_longest(row.zero_torque_ms, result.zero_torque_ms);
    reward += result.reward;
    undisturbed += result.undisturbed_reward;
    row.violations += result.violations.size() + (result.failure.empty() ? 0 : 1);
  }
  if (row.detected_by.empty()) {
    row.detected_by = "nothing needed";
  }
  if (undisturbed > 0.0) {
    row.reward_kept_percent = 100.0 * reward / undisturbed;
  }
  return row;
}

std::string fault_table(const std::vector<FaultRow>& rows) {
  std::string text =
      fmt::format("{:<40}  {:<36}  {:>11}  {:>11}  {:<24}  {:>8}  {:>10}\n", "fault", "detected by",
                  "detected ms", "torque 0 ms", "outcome", "reward %", "violations");
  for (const FaultRow& row : rows) {
    text += fmt::format("{:<40}  {:<36}  {:>11}  {:>11}  {:<24}  {:>8}  {:>10}\n", row.name, row.detected_by,
                        cell(row.detected_ms, "{}"), cell(row.zero_torque_ms, "{}"), row.outcome,
                        cell(row.reward_kept_percent, "{:.0f}"), row.violations);
  }
  return text;
}

void write_json(const FaultReport& report, const std::filesystem::path& file) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    rows.push_back(row_json(report.rows[i], report.results[i]));
  }
  nlohmann::ordered_json json = {{"plan", report.plan},    {"plant", report.plant},
                                 {"pose", report.pose},    {"bus", report.bus},
                                 {"seed", report.seed},    {"first_episode", report.first_episode},
                                 {"rows", std::move(rows)}};
  host::stamp(json);
  host::AtomicFile out(file);
  out.write(json.dump(1) + '\n');
  out.finish();
}

}  // namespace striker::sil
