// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/can/messages.hpp"
#include "firmware/host/files.hpp"
#include "firmware/host/progress.hpp"
#include "firmware/host/version.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "sil/fault/plan/plan_file.hpp"
#include "sil/fault/plan/random_faults.hpp"
#include "sil/scenario/fault_run.hpp"
#include "sil/scenario/minimise.hpp"
#include "sil/scenario/run_file.hpp"
#include "sil/scenario/worker_pool.hpp"

namespace striker::sil {

namespace {

struct Ranks {
  std::uint64_t rank = 0;
  std::uint64_t size = 1;
};

Ranks ranks_of_mpirun() {
  const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
  const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (rank == nullptr || size == nullptr) {
    return {};
  }
  return {.rank = std::strtoull(rank, nullptr, 10), .size = std::strtoull(size, nullptr, 10)};
}

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
std::string carry_out(std::uint64_t number, const CampaignOptions& options) {
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

void carry_out_share(const CampaignOptions& options, const Ranks& ranks, RunFile& file,
                     const std::function<bool()>& stop) {
  std::vector<std::uint64_t> tasks;
  std::int64_t share = 0;
  for (std::uint64_t number = ranks.rank; number < options.runs; number += ranks.size) {
    ++share;
    if (!file.runs().contains(number)) {
      tasks.push_back(number);
    }
  }
  const std::int64_t before = share - static_cast<std::int64_t>(tasks.size());
  std::int64_t done = before;
  host::ProgressLine progress("run", share, before);
  run_in_processes(
      tasks, options.jobs, [&](std::uint64_t number) { return carry_out(number, options); },
      [&](const PoolResult& result) {
        file.append(result.task,
                    result.failure.empty() ? result.line : failed_line(result.task, options, result.failure));
        if (progress.due(++done)) {
          progress.show(done, "");
        }
      },
      stop);
  progress.finish();
}

bool complete(const RunFile& file, const CampaignOptions& options) {
  for (std::uint64_t number = 0; number < options.runs; ++number) {
    if (!file.runs().contains(number)) {
      return false;
    }
  }
  return true;
}

void wait_for_others(const CampaignOptions& options, RunFile& file, const std::function<bool()>& stop) {
  constexpr std::chrono::milliseconds pause{200};
  while (!complete(file, options) && !stop()) {
    std::this_thread::sleep_for(pause);
    file.read_again();
  }
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
  const Ranks ranks = ranks_of_mpirun();
  host::require_writable(options.directory);
  RunFile file(options.directory / "runs.jsonl", header_of(options));
  carry_out_share(options, ranks, file, stop);
  if (ranks.rank > 0) {
    return {.reports = false};
  }
  if (ranks.size > 1) {
    wait_for_others(options, file, stop);
  }
  if (ranks.size == 1 || complete(file, options)) {
    file.finish();
  }
  return summary_of(options, file);
}

}  // namespace striker::sil
