// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "firmware/can/messages.hpp"
#include "firmware/host/files.hpp"
#include "firmware/host/version.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "sil/fault/plan/plan_file.hpp"
#include "sil/fault/plan/random_faults.hpp"
#include "sil/scenario/fault_run.hpp"
#include "sil/scenario/minimise.hpp"
#include "sil/scenario/runs/shared_runs.hpp"

namespace striker::sil {

namespace {

std::string header_of(const CampaignOptions& options) {
  const nlohmann::ordered_json header = {{"campaign", options.seed},
                                         {"policy", fmt::format("{:08x}", loop::BuiltInPilot::identity)},
                                         {"protocol", can::protocol_version},
                                         {"git_hash", host::git_hash()}};
  return header.dump();
}

FaultResult play(const FaultCase& faults) {
  return play_fault(faults, {.interface = {}, .sees_recovery = false, .sees_undisturbed = false});
}

bool breaks(const FaultCase& faults, Invariant invariant) {
  const FaultResult result = play(faults);
  return std::any_of(result.violations.begin(), result.violations.end(),
                     [&](const Violation& one) { return one.invariant == invariant; });
}

std::filesystem::path plan_file(const CampaignOptions& options, std::uint64_t number) {
  return options.directory / fmt::format("violation-{}.toml", number);
}

std::string line_of(std::uint64_t number, const FaultCase& faults, const FaultResult& result) {
  nlohmann::ordered_json line = {{"run", number},
                                 {"faults", in_words(faults.faults)},
                                 {"plant", name_of(*faults.setup.plant)},
                                 {"pose", *faults.setup.anywhere ? "anywhere" : "origin"},
                                 {"torque_scale", faults.setup.torque_scale}};
  line.update(nlohmann::ordered_json::parse(to_line(result)));
  line.erase("undisturbed_reward");
  return line.dump();
}

// In a worker: the run's line, and the plan that replays its violation.
std::string run_of(std::uint64_t number, const CampaignOptions& options) {
  const FaultCase faults = random_case(options.seed, number);
  const FaultResult result = play(faults);
  if (!result.violations.empty()) {
    const Invariant broken = result.violations.front().invariant;
    const FaultCase smallest = minimised(faults, [&](const FaultCase& one) { return breaks(one, broken); });
    host::write_file(plan_file(options, number), plan_text({.cases = {smallest}}));
  }
  return line_of(number, faults, result);
}

// The line of a run whose process died: there is nothing to minimise it with.
std::string failed_line(std::uint64_t number, const CampaignOptions& options, const std::string& why) {
  const FaultCase faults = random_case(options.seed, number);
  host::write_file(plan_file(options, number), plan_text({.cases = {faults}}));
  FaultResult result;
  result.failure = why;
  return line_of(number, faults, result);
}

CampaignSummary summary_of(const CampaignOptions& options, const RunFile& file) {
  CampaignSummary summary;
  for (const auto& [number, line] : file.runs()) {
    const auto run = nlohmann::json::parse(line);
    const std::string failure = run.at("failure");
    const auto& violations = run.at("violations");
    ++summary.runs;
    summary.detected += run.at("detected_ms").is_null() ? 0 : 1;
    if (failure.empty() && violations.empty()) {
      continue;
    }
    ++summary.violations;
    if (summary.first_violation.empty()) {
      const std::string what =
          failure.empty() ? fmt::format("tick {}: {}: {}", violations[0].at("tick").get<std::uint32_t>(),
                                        violations[0].at("invariant").get<std::string>(),
                                        violations[0].at("text").get<std::string>())
                          : failure;
      summary.first_violation =
          fmt::format("run {} ({}), {}; play it again with faults --plan {}", number,
                      run.at("faults").get<std::string>(), what, plan_file(options, number).string());
    }
  }
  return summary;
}

}  // namespace

CampaignSummary run_campaign(const CampaignOptions& options, const std::function<bool()>& stop) {
  host::require_writable(options.directory);
  RunFile file(options.directory / "runs.jsonl", header_of(options));
  const SharedRuns shared = {
      .runs = options.runs,
      .jobs = options.jobs,
      .carry_out = [&](std::uint64_t number) { return run_of(number, options); },
      .failed = [&](std::uint64_t number,
                    const std::string& why) { return failed_line(number, options, why); }};
  return carry_out(shared, file, stop) ? summary_of(options, file) : CampaignSummary{.reports = false};
}

}  // namespace striker::sil
