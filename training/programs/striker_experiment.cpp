// SPDX-License-Identifier: Apache-2.0
// striker-experiment: the paper's experiment over many seeds, and the readings of what the paper leaves open.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "firmware/host/command_line.hpp"
#include "firmware/host/files.hpp"
#include "firmware/host/progress.hpp"
#include "firmware/host/stop_signal.hpp"
#include "training/experiment/experiment.hpp"
#include "training/experiment/experiment_summary.hpp"
#include "training/experiment/ranks.hpp"
#include "training/experiment/summary_csv.hpp"
#include "training/experiment/summary_markdown.hpp"
#include "training/experiment/verdicts.hpp"
#include "training/experiment/workers.hpp"

namespace striker::training {

namespace {

constexpr int exit_failed_runs = 1;

struct Options {
  std::filesystem::path config;
  std::vector<std::filesystem::path> compared;  // of `compare`, in place of one configuration
  std::vector<std::string> changes;
  int seeds = 10;
  int jobs = 0;
  double ceiling = 8.21;  // of striker-ceiling --episodes 10000 --seed 1000
  std::filesystem::path out;
  bool figures = true;
};

struct ExperimentKind {
  const char* name;
  const char* says;
  std::vector<Variant> (*variants)(const std::string& base_text,
                                   const std::string& base_name);  // none of compare
  const char* table;  // the file that is written beside the summary; none if empty
  std::string (*table_of)(const std::vector<VariantSummary>& summaries);
};

constexpr std::array kinds = {
    ExperimentKind{
        "paper",
        "RCS, RCS with dummies, ACS, the printed equations; sets the paper's claims beside what was found",
        paper_variants, "claims.md", claims_table},
    ExperimentKind{"readings", "what the paper leaves open, varied: which reading comes closest to its curve",
                   paper_readings, "readings.md", readings_table},
    ExperimentKind{"widths", "the RCS state with networks of several widths", network_widths, "", nullptr},
    ExperimentKind{"compare", "trainings of your own, a configuration each", nullptr, "", nullptr},
};

struct Experiment {
  std::vector<Variant> variants;
  std::vector<SeedRun> runs;  // variant by variant
};

Experiment make_experiment(const Options& options, const ExperimentKind& kind) {
  if (kind.variants == nullptr) {
    return {.variants = compared_variants(options.compared, options.changes), .runs = {}};
  }
  const std::string text = options.config.empty() ? "" : host::read_file(options.config);
  const std::string name = options.config.empty() ? "paper.toml" : options.config.string();
  const std::string base = parse_config(text, name, options.changes).text;
  Experiment experiment;
  experiment.variants = kind.variants(base, name);
  return experiment;
}

void add_runs(Experiment& experiment, int seeds) {
  for (const Variant& variant : experiment.variants) {
    for (int seed = 1; seed <= seeds; ++seed) {
      experiment.runs.push_back({.variant = &variant, .seed = static_cast<std::uint64_t>(seed)});
    }
  }
}

// Carries out this rank's share of the runs that are not there yet; returns how many failed.
int carry_out_all(const Experiment& experiment, const Options& options, const Ranks& ranks) {
  std::vector<std::size_t> tasks;
  std::vector<std::filesystem::path> files;
  const auto rank = static_cast<std::size_t>(ranks.rank());
  for (std::size_t i = rank; i < experiment.runs.size(); i += static_cast<std::size_t>(ranks.size())) {
    if (!load_run(experiment.runs[i], options.out)) {
      tasks.push_back(i);
    }
  }
  host::ProgressLine line("run", static_cast<std::int64_t>(tasks.size()));
  std::int64_t done = 0;
  const auto failures = run_workers(
      tasks, options.jobs, [&](std::size_t i) { carry_out(experiment.runs[i], options.out); },
      [&](std::size_t i) {
        const auto paths = files_of(experiment.runs[i], options.out);
        files.insert(files.end(), paths.begin(), paths.end());
        line.show(++done, name_of(experiment.runs[i]));
      },
      host::stop_requested);
  line.finish();
  for (const WorkerFailure& failure : failures) {
    if (!host::stop_requested()) {
      fmt::print(stderr, "striker-experiment: {}: {}\n", name_of(experiment.runs[failure.task]), failure.why);
    }
  }
  ranks.collect(files);
  return ranks.sum(static_cast<int>(failures.size()));
}

// Beside this program, as the build puts it.
std::filesystem::path plotter() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "striker-plot-experiment";
}

void draw_figures(const std::filesystem::path& directory) {
  const std::string script = plotter().string();
  const std::string argument = directory.string();
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid == 0) {
    execl(script.c_str(), script.c_str(), argument.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  if (pid < 0 || waitpid(pid, &status, 0) != pid || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error(fmt::format(
        "the tables are written, but {} {} could not draw the figures; it needs Python 3 with matplotlib",
        script, argument));
  }
}

// What the figures need beside the tables.
std::string experiment_json(const std::vector<VariantSummary>& summaries, double ceiling,
                            const ExperimentKind& kind) {
  nlohmann::ordered_json json = {{"experiment", kind.name},
                                 {"seeds", summaries.front().runs},
                                 {"ceiling", ceiling},
                                 {"paper_best", nullptr}};
  if (kind.variants != nullptr) {
    json["paper_best"] = paper_best_reward;
  }
  for (const VariantSummary& summary : summaries) {
    json["variants"].push_back({{"name", summary.variant->name},
                                {"says", summary.variant->says},
                                {"episodes", summary.variant->config.run.episodes}});
  }
  return json.dump(2) + "\n";
}

int report_all(const Experiment& experiment, const Options& options, const ExperimentKind& kind) {
  std::vector<std::vector<RunFigures>> runs(experiment.variants.size());
  std::size_t missing = 0;
  for (std::size_t i = 0; i < experiment.runs.size(); ++i) {
    if (const auto figures = load_run(experiment.runs[i], options.out)) {
      runs[i / static_cast<std::size_t>(options.seeds)].push_back(*figures);
    } else {
      ++missing;
    }
  }
  if (missing > 0) {
    fmt::print(
        stderr,
        "striker-experiment: {} of {} runs are complete and kept; the same command goes on with the rest\n",
        experiment.runs.size() - missing, experiment.runs.size());
    return host::stop_requested() ? host::exit_interrupted : exit_failed_runs;
  }
  const auto summaries = summarise_variants(experiment.variants, runs, options.ceiling);
  const std::string markdown = summary_markdown(summaries, options.ceiling);
  host::write_file(options.out / "experiment.json", experiment_json(summaries, options.ceiling, kind));
  host::write_file(options.out / "summary.csv", summary_csv(summaries));
  host::write_file(options.out / "curves.csv", curves_csv(summaries));
  host::write_file(options.out / "summary.md", markdown);
  fmt::print("{}", markdown);
  if (kind.table_of != nullptr) {
    const std::string table = kind.table_of(summaries);
    host::write_file(options.out / kind.table, table);
    fmt::print("\n{}", table);
  }
  if (options.figures) {
    draw_figures(options.out);
  }
  fmt::print("\n{}\n", options.out.string());
  return 0;
}

int carry_out_experiment(Options options, const ExperimentKind& kind) {
  const Ranks ranks;
  if (options.jobs == 0) {
    options.jobs = ranks.size() > 1 ? 1 : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  }
  Experiment experiment = make_experiment(options, kind);
  add_runs(experiment, options.seeds);
  host::require_writable(options.out);
  host::catch_stop_signals();
  const int failures = carry_out_all(experiment, options, ranks);
  if (ranks.rank() > 0) {
    return failures > 0 ? exit_failed_runs : 0;
  }
  return report_all(experiment, options, kind);
}

void add_options(CLI::App& command, Options& options, const ExperimentKind& kind) {
  if (kind.variants == nullptr) {
    striker::host::reads_file(command.add_option("CONFIG", options.compared,
                                                 "TOML files as training/configs/paper.toml, two or more"))
        ->required()
        ->expected(2, 100);
  } else {
    command.add_option("--config", options.config,
                       "the training that is varied; training/configs/paper.toml if not given");
  }
  command.add_option("--seeds", options.seeds, "runs a variant, with seeds 1 to N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      .add_option("--jobs", options.jobs,
                  "runs at a time; all cores, and under mpirun 1 a process, if not given")
      ->check(CLI::Range(1, 1024));
  command.add_option("--set", options.changes, "changes a key of it, or of all: --set run.episodes=1000")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--ceiling", options.ceiling, "the best mean reward possible, as striker-ceiling finds it")
      ->check(CLI::Range(-3.9, 1000.0))
      ->capture_default_str();
  command.add_flag("!--no-figures", options.figures, "write the tables only");
  command.add_option("-o,--output", options.out, "directory for the results; made if missing")->required();
}

}  // namespace

}  // namespace striker::training

int main(int argc, char** argv) {
  using namespace striker::training;
  CLI::App app(
      "Trains each variant of the paper's experiment, or trainings of your own, with several seeds, and writes every run's learning\n"
      "curve, model and figures (DIR/runs), a summary with intervals (summary.csv, summary.md, curves.csv, experiment.json)\n"
      "and figures (SVG and PNG). Complete runs are kept: the same command goes on where it was interrupted.\n"
      "Equal bytes with any number of jobs, and under mpirun, where each process takes its share of the runs.",
      "striker-experiment");
  Options options;
  for (const ExperimentKind& kind : kinds) {
    add_options(*app.add_subcommand(kind.name, kind.says), options, kind);
  }
  app.require_subcommand(1);
  return striker::host::run(app, argc, argv, [&] {
    const auto chosen = std::find_if(kinds.begin(), kinds.end(), [&](const ExperimentKind& kind) {
      return app.got_subcommand(kind.name);
    });
    return carry_out_experiment(options, *chosen);
  });
}
