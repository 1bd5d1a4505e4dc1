// SPDX-License-Identifier: Apache-2.0
// A training as a directory: interrupted, resumed, damaged.
#include "training/run/training_run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <csignal>

#include "tests/training/fixtures.hpp"

namespace striker::training {
namespace {

Config some_config() {
  Config config = parse_config(
      "[run]\nepisodes = 60\nevaluation_period = 20\nvalidation_episodes = 10\ncheckpoint_period = 25\n"
      "[learner]\nwarm_up = 200\nreplay_size = 700\nn_step = 3\ntarget_period = 50\nprioritised = true\n"
      "[network]\ndueling = true\n[optimiser]\naveraging = 0.99\nfinal_fraction = 0.1\n[task]\ndummies = 1\n"
      "velocities = \"both\"\n",
      "some.toml");
  return config;
}

bool go_on(const CurveRow& /*row*/) {
  return true;
}

TrainingProgress stop_after(int episodes) {
  return [episodes](const CurveRow& row) { return row.episode.episode + 1 < episodes; };
}

const std::vector<std::string> results = {"model.safetensors", "best.safetensors", "learning_curve.csv",
                                          "evaluations.csv"};

void expect_same_results(const TemporaryDirectory& directory, const std::string& a, const std::string& b) {
  for (const std::string& name : results) {
    const std::string content = content_of(directory / a / name);
    EXPECT_FALSE(content.empty()) << name;
    EXPECT_EQ(content, content_of(directory / b / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(directory / (b + "/checkpoint.safetensors")));
}

// Wherever it was interrupted, more than once: the same bytes as without.
TEST(TrainingRun, ResumesToTheSameBytes) {
  const TemporaryDirectory directory;
  const Config config = some_config();
  EXPECT_FALSE(train_into(directory / "whole", config, 1, false, go_on).interrupted);
  for (const int at : {1, 20, 33, 59}) {
    const auto part = directory / ("part" + std::to_string(at));
    EXPECT_TRUE(train_into(part, config, 1, false, stop_after(at)).interrupted);
    EXPECT_TRUE(train_into(part, config, 1, true, stop_after(at + 1)).interrupted || at == 59);
    if (at != 59) {
      EXPECT_FALSE(train_into(part, config, 1, true, go_on).interrupted);
    }
    expect_same_results(directory, "whole", "part" + std::to_string(at));
  }
}

// A crash after a checkpoint: what was written later is dropped.
TEST(TrainingRun, ACrashedRunGoesOnFromItsCheckpoint) {
  const TemporaryDirectory directory;
  const Config config = some_config();
  (void)train_into(directory / "whole", config, 1, false, go_on);
  (void)train_into(directory / "part", config, 1, false, stop_after(30));
  const std::string checkpoint = content_of(directory / "part/checkpoint.safetensors");
  (void)train_into(directory / "part", config, 1, true, stop_after(45));
  write_to(directory / "part/checkpoint.safetensors", checkpoint);
  (void)train_into(directory / "part", config, 1, true, go_on);
  expect_same_results(directory, "whole", "part");
}

TEST(TrainingRun, KeepsTheBestOfItsEvaluations) {
  const TemporaryDirectory directory;
  const TrainingResult result = train_into(directory / "run", some_config(), 1, false, go_on);
  std::istringstream lines(content_of(directory / "run/evaluations.csv"));
  std::string line;
  std::getline(lines, line);
  double best = -1e9;
  int rows = 0;
  for (; std::getline(lines, line); ++rows) {
    const auto first = line.find(',');
    const auto second = line.find(',', first + 1);
    const double mean = std::stod(line.substr(first + 1, second - first - 1));
    EXPECT_EQ(line.substr(second + 1), mean > best ? "1" : "0");
    best = std::max(best, mean);
  }
  EXPECT_EQ(rows, 3);
  ASSERT_TRUE(result.best_mean_reward.has_value());
  EXPECT_NEAR(*result.best_mean_reward, best, 1e-3);
  EXPECT_EQ(load_model(directory / "run/best.safetensors").metadata.at("mean_reward"),
            fmt::format("{:.3f}", *result.best_mean_reward));
}

std::string complaint_of(const std::filesystem::path& run, const Config& config, std::uint64_t seed,
                         bool resume) {
  try {
    (void)train_into(run, config, seed, resume, go_on);
  } catch (const std::runtime_error& error) {
    std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  return "it ran";
}

TEST(TrainingRun, WhatCannotBeResumedIsRefused) {
  const TemporaryDirectory directory;
  const Config config = some_config();
  const auto run = directory / "run";
  EXPECT_NE(complaint_of(run, config, 1, true).find("no checkpoint"), std::string::npos);
  (void)train_into(run, config, 1, false, stop_after(45));
  const auto refused = [&](const std::string& why, const Config& with, std::uint64_t seed, bool resume) {
    const std::string message = complaint_of(run, with, seed, resume);
    EXPECT_NE(message.find(why), std::string::npos) << message;
    EXPECT_NE(message.find(run.string()), std::string::npos) << message;
  };
  refused("--resume", config, 1, false);
  refused("seed 1, not 2", config, 2, true);
  refused("another configuration", parse_config(config.text, "f", {"learner.gamma=0.9"}), 1, true);

  const auto damaged = [&](const std::string& name, const std::string& content, const std::string& why) {
    const std::string whole = content_of(run / name);
    write_to(run / name, content);
    refused(why, config, 1, true);
    write_to(run / name, whole);
  };
  const std::string curve = content_of(run / "learning_curve.csv");
  damaged("learning_curve.csv", curve.substr(0, curve.size() / 2), "cut off");
  damaged("learning_curve.csv", curve.substr(0, curve.size() - 1), "cut off");
  damaged("learning_curve.csv", "", "line 1");
  const std::string checkpoint = content_of(run / "checkpoint.safetensors");
  damaged("checkpoint.safetensors", checkpoint.substr(0, checkpoint.size() - 8), "truncated");
  damaged("checkpoint.safetensors", replaced(checkpoint, "replay.pushed", "replay.pusheX"), "replay.pushed");
  EXPECT_EQ(complaint_of(run, config, 1, true), "it ran");
}

// A file system without room: the error says so, and the checkpoint of before is still whole.
TEST(TrainingRun, AFullDiskKeepsWhatWasThere) {
  const TemporaryDirectory directory;
  const Config config = some_config();
  const auto run = directory / "run";
  (void)train_into(directory / "whole", config, 1, false, go_on);
  (void)train_into(run, config, 1, false, stop_after(30));
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 4096;
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = complaint_of(run, config, 1, true);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(message.find(run.string()), std::string::npos) << message;
  EXPECT_EQ(complaint_of(run, config, 1, true), "it ran");
  expect_same_results(directory, "whole", "run");
}

}  // namespace
}  // namespace striker::training
