// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/fault_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "firmware/host/command_line.hpp"
#include "firmware/host/progress.hpp"
#include "firmware/host/stop_signal.hpp"
#include "sil/fault/plan/catalogue.hpp"
#include "sil/fault/plan/plan_file.hpp"
#include "sil/programs/kick_options.hpp"
#include "sil/scenario/fault_report.hpp"
#include "sil/scenario/runs/worker_pool.hpp"

namespace striker::sil {

namespace {

FaultRunOptions run_options(const FaultOptions& options, std::uint64_t episode) {
  return {.plant = plant_kind_of(options.plant).value(),
          .anywhere = options.pose == "anywhere",
          .seed = options.seed,
          .episode = episode,
          .interface = interface_of(options.bus)};
}

// Of a plan from a file every case is played, or the first that cannot be says why not.
FaultPlan plan_of(const FaultOptions& options) {
  if (!options.plan.empty()) {
    return read_plan(options.plan);
  }
  FaultPlan plan = fault_catalogue();
  const std::size_t before = plan.cases.size();
  std::erase_if(plan.cases, [&](const FaultCase& one) {
    return !std::all_of(one.faults.begin(), one.faults.end(),
                        [&](const Fault& fault) { return possible(fault, options.bus == "inproc"); });
  });
  fmt::print(stderr, "striker-sil: {} of {} cases are for another --bus and left out\n",
             before - plan.cases.size(), before);
  return plan;
}

// A case that names its episode is played once.
std::uint64_t episodes_of(const FaultCase& faults, const FaultOptions& options) {
  return faults.setup.episode ? 1 : options.episodes;
}

std::vector<std::vector<FaultResult>> play_all(const FaultPlan& plan, const FaultOptions& options) {
  std::vector<std::vector<FaultResult>> results;
  std::vector<std::pair<std::size_t, std::uint64_t>> runs;  // case, number within it
  for (std::size_t i = 0; i < plan.cases.size(); ++i) {
    const std::uint64_t episodes = episodes_of(plan.cases[i], options);
    results.emplace_back(episodes);
    for (std::uint64_t k = 0; k < episodes; ++k) {
      runs.emplace_back(i, k);
    }
  }
  std::vector<std::uint64_t> tasks(runs.size());
  std::iota(tasks.begin(), tasks.end(), 0);
  host::ProgressLine progress("run", static_cast<std::int64_t>(tasks.size()));
  std::int64_t done = 0;
  run_in_processes(
      tasks, {.jobs = options.bus == "inproc" ? options.jobs : 1},
      [&](std::uint64_t task) {
        const auto [one, number] = runs[task];
        return to_line(play_fault(plan.cases[one], run_options(options, options.first + number)));
      },
      [&](const PoolResult& result) {
        const auto [one, number] = runs[result.task];
        FaultResult& into = results[one][number];
        if (result.failure.empty()) {
          into = result_from_line(result.line);
        } else {
          into.failure = result.failure;
        }
        if (progress.due(++done)) {
          progress.show(done, "");
        }
      },
      host::stop_requested);
  progress.finish();
  return results;
}

// One line for the first violation; false if there is none.
bool tell_violation(const FaultReport& report) {
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    for (const FaultResult& result : report.results[i]) {
      if (!result.failure.empty()) {
        fmt::print(stderr, "striker-sil: \"{}\": {}\n", report.rows[i].name, result.failure);
        return true;
      }
      if (!result.violations.empty()) {
        const Violation& first = result.violations.front();
        fmt::print(stderr, "striker-sil: \"{}\", tick {}: {}: {}\n", report.rows[i].name, first.tick,
                   name_of(first.invariant), first.text);
        return true;
      }
    }
  }
  return false;
}

}  // namespace

void define(CLI::App& faults, FaultOptions& options) {
  auto* const plan = host::reads_file(
      faults.add_option("--plan", options.plan, "a TOML file with the faults (sil/fault/README.md)"));
  faults.add_flag("--all", options.all, "the built-in faults, every kind of them; so without --plan")
      ->excludes(plan);
  faults.add_option("--plant", options.plant, "where the plan names none")
      ->check(CLI::IsMember({"servo", "drive"}))
      ->capture_default_str();
  faults.add_option("--pose", options.pose, "where the plan names none")
      ->check(CLI::IsMember({"origin", "anywhere"}))
      ->capture_default_str();
  faults.add_option("--bus", options.bus, "inproc, or can:IFACE with a striker-firmware --clock sync on it")
      ->check(bus_problem)
      ->capture_default_str();
  faults.add_option("--episodes", options.episodes, "a fault, where the plan names none")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  faults.add_option("--first", options.first, "number of the first episode")->capture_default_str();
  faults.add_option("--seed", options.seed, "of episodes and faults")->capture_default_str();
  faults.add_option("--jobs", options.jobs, "processes; the results are the same")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  host::writes_file(
      faults.add_option("--json", options.json, "write the table, with every episode and violation"));
  faults.final_callback([&faults, &options] {
    host::require_meaning(faults, options.bus == "inproc", {"--jobs"},
                          "--bus inproc: a bus serves one run at a time");
  });
}

int play_faults(const FaultOptions& options) {
  const FaultPlan plan = plan_of(options);
  FaultReport report{.plan = options.plan.empty() ? "built-in" : options.plan,
                     .plant = options.plant,
                     .pose = options.pose,
                     .bus = options.bus,
                     .seed = options.seed,
                     .first_episode = options.first,
                     .rows = {},
                     .results = play_all(plan, options)};
  if (host::stop_requested()) {
    fmt::print(stderr, "striker-sil: stopped; no report was written\n");
    return host::exit_interrupted;
  }
  for (std::size_t i = 0; i < plan.cases.size(); ++i) {
    report.rows.push_back(row_of(plan.cases[i], report.results[i]));
  }
  fmt::print("{}", fault_table(report.rows));
  if (!options.json.empty()) {
    write_json(report, options.json);
  }
  return tell_violation(report) ? exit_violated : 0;
}

}  // namespace striker::sil
