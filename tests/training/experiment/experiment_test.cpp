// SPDX-License-Identifier: Apache-2.0
// The experiment: its workers, its runs as files, its program from start to end.
#include "training/experiment/experiment.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <set>

#include "tests/training/fixtures.hpp"
#include "training/experiment/experiment_summary.hpp"
#include "training/experiment/summary_markdown.hpp"
#include "training/experiment/verdicts.hpp"
#include "training/experiment/workers.hpp"

namespace striker::training {
namespace {

const std::vector<std::size_t> five = {0, 1, 2, 3, 4};

bool never() {
  return false;
}

TEST(Workers, EveryTaskIsDoneOnceWhateverTheJobs) {
  for (const int jobs : {1, 2, 8}) {
    const TemporaryDirectory directory;
    std::multiset<std::size_t> finished;
    const auto failures = run_workers(
        five, jobs, [&](std::size_t i) { write_to(directory / std::to_string(i), "done"); },
        [&](std::size_t i) { finished.insert(i); }, never);
    EXPECT_TRUE(failures.empty());
    EXPECT_EQ(finished, (std::multiset<std::size_t>{0, 1, 2, 3, 4}));
    for (const std::size_t i : five) {
      EXPECT_EQ(content_of(directory / std::to_string(i)), "done");
    }
  }
}

// One that throws and one that is killed are named; the others go on.
TEST(Workers, FailuresTakeNothingElseWithThem) {
  std::set<std::size_t> finished;
  const auto failures = run_workers(
      five, 2,
      [](std::size_t i) {
        if (i == 1) {
          throw std::runtime_error("no room");
        }
        if (i == 3) {
          kill(getpid(), SIGKILL);
        }
      },
      [&](std::size_t i) { finished.insert(i); }, never);
  EXPECT_EQ(finished, (std::set<std::size_t>{0, 2, 4}));
  ASSERT_EQ(failures.size(), 2U);
  EXPECT_EQ(failures[0].task, 1U);
  EXPECT_EQ(failures[0].why, "no room");
  EXPECT_EQ(failures[1].task, 3U);
  EXPECT_NE(failures[1].why.find("killed by signal 9"), std::string::npos);
}

TEST(Workers, StopStartsNoMore) {
  int finished = 0;
  run_workers(
      five, 1, [](std::size_t) {}, [&](std::size_t) { ++finished; }, [&] { return finished == 2; });
  EXPECT_EQ(finished, 2);
}

std::vector<Variant> short_variants() {
  const std::string base = parse_config("[run]\nepisodes = 260\n[learner]\nwarm_up = 5000\n", "f").text;
  std::vector<Variant> variants = paper_variants(base, "short");
  variants.resize(2);
  return variants;
}

TEST(Experiment, VariantsAreThePapers) {
  const auto variants = paper_variants("", "paper");
  std::vector<int> inputs;
  inputs.reserve(variants.size());
  for (const Variant& variant : variants) {
    inputs.push_back(variant.config.shape.inputs);
  }
  EXPECT_EQ(inputs, (std::vector<int>{6, 7, 8, 10, 14, 10, 10, 6}));
  EXPECT_EQ(variants[6].config.environments.front().pose, sil::PoseMode::anywhere);
  EXPECT_EQ(variants[7].config.environments.front().equations, Equations::printed);
  std::set<std::string> texts;
  std::size_t count = 0;
  for (const auto& all : {variants, paper_readings("", "paper"), network_widths("", "paper")}) {
    count += all.size();
    for (const Variant& variant : all) {
      texts.insert(variant.config.text);
    }
  }
  EXPECT_EQ(texts.size(), count - 2);  // "rcs" is "official" and "width-64"
}

TEST(Experiment, ARunComesBackFromItsFiles) {
  const TemporaryDirectory directory;
  const auto variants = short_variants();
  const SeedRun run{.variant = &variants[1], .seed = 3};
  EXPECT_FALSE(load_run(run, directory / "e"));
  carry_out(run, directory / "e");
  const auto figures = load_run(run, directory / "e");
  ASSERT_TRUE(figures);
  EXPECT_EQ(figures->rewards.size(), 260U);
  EXPECT_LT(figures->origin_mean, 0.0);
}

// It says so, and leaves no file that could be taken for a run.
TEST(Experiment, ADivergedRunIsNone) {
  const TemporaryDirectory directory;
  const std::string diverging =
      "[run]\nepisodes = 200\n[learner]\nwarm_up = 100\ngradient_steps = 5\ntarget_period = 1\ngamma = 1.0\n"
      "[optimiser]\nlearning_rate = 0.3\n";
  const Variant variant{.name = "far", .says = "", .config = parse_config(diverging, "far.toml")};
  const SeedRun run{.variant = &variant, .seed = 1};
  try {
    carry_out(run, directory / "e");
    FAIL() << "it ran";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("diverged"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("optimiser.learning_rate"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(load_run(run, directory / "e").has_value());
  for (const auto& file : files_of(run, directory / "e")) {
    EXPECT_FALSE(std::filesystem::exists(file)) << file;
  }
}

TEST(Experiment, DamagedRunsAreRefusedByName) {
  const TemporaryDirectory directory;
  const auto variants = short_variants();
  const SeedRun run{.variant = &variants[0], .seed = 1};
  carry_out(run, directory / "e");
  const auto refused = [&](const std::filesystem::path& file, const std::string& content, const SeedRun& as) {
    const std::string whole = content_of(file);
    write_to(file, content);
    try {
      (void)load_run(as, directory / "e");
      ADD_FAILURE() << file << " was read";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
    }
    write_to(file, whole);
  };
  const auto [curve, model, figures] = files_of(run, directory / "e");
  refused(curve, content_of(curve).substr(0, 3000), run);
  refused(curve, "episode\n", run);
  refused(model, content_of(model).substr(0, 3000), run);
  refused(figures, "{", run);
  Variant other = variants[0];
  other.config.text += "#";
  refused(figures, content_of(figures), {.variant = &other, .seed = 1});
  EXPECT_TRUE(load_run(run, directory / "e"));
}

// A run that first exceeds a level in a known episode, and never another.
TEST(Experiment, TheSummaryIsThatOfItsRuns) {
  const auto variants = short_variants();
  std::vector<std::vector<RunFigures>> runs(2);
  for (int seed = 0; seed < 4; ++seed) {
    RunFigures late;  // -10, then 10 from episode 1000 + 100 seed on
    for (int episode = 0; episode < 3000; ++episode) {
      late.rewards.push_back(episode < 1000 + 100 * seed ? -10.0 : 10.0);
    }
    late.origin_mean = 5.0 + seed;
    late.anywhere_mean = 4.0 + seed;
    runs[0].push_back(late);
    RunFigures never;
    never.rewards.assign(3000, -5.0);
    runs[1].push_back(never);
  }
  const auto summaries = summarise_variants(variants, runs, 8.0);
  const VariantSummary& late = summaries[0];
  // -4 of a window from -10 to 10: more than 75 of its 250 episodes.
  EXPECT_EQ(late.crossings[0].episode.value, 1150.0 + 76.0);
  EXPECT_EQ(late.crossings[0].reached, 4);
  EXPECT_EQ(late.crossings[1].episode.value, 1150.0 + 126.0);
  EXPECT_EQ(late.start.value, -10.0);
  EXPECT_EQ(late.best.value, 10.0);
  EXPECT_EQ(late.final_mean.value, 10.0);
  EXPECT_NEAR(late.origin_mean.value, 6.5, 1e-12);
  EXPECT_NEAR(late.loss.value, 1.0, 1e-12);
  EXPECT_EQ(summaries[1].crossings[0].reached, 0);
  EXPECT_EQ(figure(summaries[1].crossings[0], 4), "never");
  EXPECT_EQ(figure(summaries[0].crossings[0], 4).substr(0, 6), "1226 [");
  EXPECT_EQ(summaries[1].crossings[0].episode.value, 3001.0);
  EXPECT_EQ(summaries[1].behind_first.value, 1.0);
  EXPECT_NE(claims_table(summaries).find("1226"), std::string::npos);
  EXPECT_NE(readings_table(summaries).find("Closest: RCS, 6 inputs"), std::string::npos);
}

class ExperimentProgram : public testing::Test {
 protected:
  int run(const std::string& directory, const std::string& more, const std::string& before = "") {
    const std::string command = fmt::format(
        "{} {} paper --seeds 1 --set run.episodes=260 --set learner.warm_up=100000 --ceiling 8 -o {} {} > {} "
        "2>&1",
        before, STRIKER_EXPERIMENT, (directory_ / directory).string(), more, (directory_ / "log").string());
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::map<std::string, std::string> files(const std::string& directory) {
    std::map<std::string, std::string> contents;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(directory_ / directory)) {
      if (entry.is_regular_file()) {
        contents[entry.path().lexically_relative(directory_ / directory).string()] = content_of(entry.path());
      }
    }
    return contents;
  }

  [[nodiscard]] std::string log() const { return content_of(directory_ / "log"); }

  TemporaryDirectory directory_;
};

TEST_F(ExperimentProgram, TheSameBytesWithOneJobTwoJobsAndResumed) {
  ASSERT_EQ(run("one", "--jobs 1"), 0) << log();
  const auto wanted = files("one");
  EXPECT_EQ(wanted.size(), 8U * 3U + 4U + 1U + 4U);  // nothing learns, so that no level tells variants apart
  EXPECT_TRUE(wanted.contains("learning_curves.svg"));
  ASSERT_EQ(run("two", "--jobs 2"), 0) << log();
  EXPECT_TRUE(files("two") == wanted);
  for (const auto& entry : std::filesystem::directory_iterator(directory_ / "two")) {
    if (entry.is_regular_file()) {
      std::filesystem::remove(entry.path());
    }
  }
  std::filesystem::remove_all(directory_ / "two/runs/rcs+2");
  std::filesystem::remove(directory_ / "two/runs/rcs/seed-1.json");
  ASSERT_EQ(run("two", "--jobs 1"), 0) << log();
  EXPECT_TRUE(files("two") == wanted);
}

// Open MPI leaves memory behind when it ends, so this one is not for the sanitizers.
TEST_F(ExperimentProgram, TheSameBytesUnderMpirun) {
  ASSERT_EQ(run("one", "--jobs 2"), 0) << log();
  ASSERT_EQ(run("mpi", "",
                "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -np 2"),
            0)
      << log();
  EXPECT_TRUE(files("mpi") == files("one"));
}

TEST_F(ExperimentProgram, BadInputIsRefused) {
  ASSERT_EQ(run("one", "--no-figures"), 0) << log();
  const auto curve = directory_ / "one/runs/rcs/seed-1.csv";
  const std::string whole = content_of(curve);
  write_to(curve, whole.substr(0, 1000));
  EXPECT_EQ(run("one", "--no-figures"), 2);
  EXPECT_NE(log().find(curve.string()), std::string::npos) << log();
  EXPECT_NE(log().find("cut off"), std::string::npos) << log();
  write_to(curve, whole);
  EXPECT_EQ(run("one", "--no-figures --set learner.gamma=0.5"), 2);
  EXPECT_NE(log().find("another configuration"), std::string::npos) << log();
  EXPECT_EQ(run("other", "--set learner.gama=0.5"), 2);
  EXPECT_NE(log().find("learner.gama"), std::string::npos) << log();
  EXPECT_EQ(run("/proc/no", ""), 2);
}

}  // namespace
}  // namespace striker::training
