// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/campaign_command.hpp"

#include <fmt/core.h>

#include "firmware/host/command_line.hpp"
#include "firmware/host/stop_signal.hpp"
#include "sil/programs/fault_command.hpp"

namespace striker::sil {

void define(CLI::App& campaign, CampaignOptions& options) {
  campaign.add_option("--runs", options.runs, "how many; a run is a function of seed and number")
      ->check(CLI::Range(1, 100'000'000))
      ->capture_default_str();
  campaign.add_option("--jobs", options.jobs, "processes; the results are the same")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  campaign.add_option("--seed", options.seed, "of the faults, robots and episodes")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 53U))
      ->capture_default_str();
  campaign
      .add_option("--out", options.directory,
                  "directory of runs.jsonl and of a plan for each violation; runs that are there are kept")
      ->required();
}

int play_campaign(const CampaignOptions& options) {
  const CampaignSummary summary = run_campaign(options, host::stop_requested);
  if (!summary.reports) {
    return 0;
  }
  fmt::print("{} runs: {} in which the controller told a fault, {} with a violation\n", summary.runs,
             summary.detected, summary.violations);
  if (!summary.first_violation.empty()) {
    fmt::print(stderr, "striker-sil: {}\n", summary.first_violation);
  }
  if (host::stop_requested()) {
    fmt::print(stderr, "striker-sil: stopped after {} of {} runs; the same command goes on with the rest\n",
               summary.runs, options.runs);
    return host::exit_interrupted;
  }
  return summary.violations > 0 ? exit_violated : 0;
}

}  // namespace striker::sil
