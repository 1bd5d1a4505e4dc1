// SPDX-License-Identifier: Apache-2.0
// A training as a directory: interrupted, resumed, damaged.
#include "training/run/directory/train_into.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <csignal>

#include "tests/training/fixtures.hpp"
#include "training/model/safetensors.hpp"

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
}

// Wherever it was interrupted, more than once: the same bytes as without.
TEST(TrainingRun, ResumesToTheSameBytes) {
  const TemporaryDirectory directory;
  const Config config = some_config();
  EXPECT_FALSE(train_into(directory / "whole", config, 1, Start::fresh, go_on).interrupted);
  for (const int at : {1, 20, 33, 59}) {
    const auto part = directory / ("part" + std::to_string(at));
    EXPECT_TRUE(train_into(part, config, 1, Start::fresh, stop_after(at)).interrupted);
    EXPECT_TRUE(train_into(part, config, 1, Start::resume, stop_after(at + 1)).interrupted || at == 59);
    if (at != 59) {
      EXPECT_FALSE(train_into(part, config, 1, Start::resume, go_on).interrupted);
    }
    expect_same_results(directory, "whole", "part" + std::to_string(at));
  }
}

// A crash after a checkpoint: what was written later is dropped.
TEST(TrainingRun, ACrashedRunGoesOnFromItsCheckpoint) {
  const TemporaryDirectory directory;
  const Config config = some_config();
  (void)train_into(directory / "whole", config, 1, Start::fresh, go_on);
  (void)train_into(directory / "part", config, 1, Start::fresh, stop_after(30));
  const std::string checkpoint = content_of(directory / "part/checkpoint.safetensors");
  (void)train_into(directory / "part", config, 1, Start::resume, stop_after(45));
  write_to(directory / "part/checkpoint.safetensors", checkpoint);
  (void)train_into(directory / "part", config, 1, Start::resume, go_on);
  expect_same_results(directory, "whole", "part");
}

TEST(TrainingRun, KeepsTheBestOfItsEvaluations) {
  const TemporaryDirectory directory;
  const TrainingResult result = train_into(directory / "run", some_config(), 1, Start::fresh, go_on);
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
                         Start start) {
  try {
    (void)train_into(run, config, seed, start, go_on);
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
  EXPECT_NE(complaint_of(run, config, 1, Start::resume).find("no checkpoint"), std::string::npos);
  (void)train_into(run, config, 1, Start::fresh, stop_after(45));
  const auto refused = [&](const std::string& why, const Config& with, std::uint64_t seed, Start start) {
    const std::string message = complaint_of(run, with, seed, start);
    EXPECT_NE(message.find(why), std::string::npos) << message;
    EXPECT_NE(message.find(run.string()), std::string::npos) << message;
  };
  refused("--resume", config, 1, Start::fresh);
  refused("seed 1, not 2", config, 2, Start::resume);
  refused("learner.gamma was 0.95 and is 0.9", parse_config(config.text, "f", {"learner.gamma=0.9"}), 1,
          Start::resume);

  const auto damaged = [&](const std::string& name, const std::string& content, const std::string& why) {
    const std::string whole = content_of(run / name);
    write_to(run / name, content);
    refused(why, config, 1, Start::resume);
    write_to(run / name, whole);
  };
  const std::string curve = content_of(run / "learning_curve.csv");
  damaged("learning_curve.csv", curve.substr(0, curve.size() / 2), "cut off");
  damaged("learning_curve.csv", curve.substr(0, curve.size() - 1), "cut off");
  damaged("learning_curve.csv", "", "line 1");
  const std::string checkpoint = content_of(run / "checkpoint.safetensors");
  damaged("checkpoint.safetensors", checkpoint.substr(0, checkpoint.size() - 8), "truncated");
  damaged("checkpoint.safetensors", replaced(checkpoint, "replay.pushed", "replay.pusheX"), "replay.pushed");
  EXPECT_EQ(complaint_of(run, config, 1, Start::resume), "it ran");
}

// What a training wrote, and nothing else, goes when it is begun anew; without being told, nothing goes.
TEST(TrainingRun, AUsedDirectoryIsLeftAloneUnlessForced) {
  const TemporaryDirectory directory;
  const Config config = some_config();
  const auto run = directory / "run";
  (void)train_into(run, config, 1, Start::fresh, go_on);
  write_to(run / "notes.txt", "mine");
  const std::string model = content_of(run / "model.safetensors");
  const Config other =
      parse_config(config.text, "f", {"run.episodes=5", "run.evaluation_period=0", "network.hidden=[8, 8]"});
  EXPECT_NE(complaint_of(run, other, 2, Start::fresh).find("--force"), std::string::npos);
  EXPECT_EQ(content_of(run / "model.safetensors"), model);
  EXPECT_NE(complaint_of(run, config, 1, Start::resume).find("complete, with 60 episodes"),
            std::string::npos);
  (void)train_into(run, other, 2, Start::force, go_on);
  EXPECT_EQ(load_model(run / "model.safetensors").parameters.shape().hidden, (std::vector{8, 8}));
  EXPECT_FALSE(std::filesystem::exists(run / "best.safetensors"));
  EXPECT_FALSE(std::filesystem::exists(run / "evaluations.csv"));
  EXPECT_EQ(content_of(run / "notes.txt"), "mine");
  for (const char* name : {"best.safetensors", "speed.csv", "checkpoint.safetensors"}) {
    write_to(directory / (std::string("alone.") + name), "");
    std::filesystem::create_directories(directory / "one");
    std::filesystem::rename(directory / (std::string("alone.") + name), directory / "one" / name);
    EXPECT_NE(complaint_of(directory / "one", other, 2, Start::fresh).find(name), std::string::npos);
    std::filesystem::remove_all(directory / "one");
  }
}

// Where no schedule looks at the number of episodes, a training that goes on is the same as one that was that long.
TEST(TrainingRun, AFinishedTrainingGoesOnWithMoreEpisodes) {
  const TemporaryDirectory directory;
  const auto with_episodes = [](int episodes) {
    return parse_config(some_config().text, "some.toml",
                        {fmt::format("run.episodes={}", episodes), "optimiser.final_fraction=1.0",
                         "learner.prioritised=false"});
  };
  (void)train_into(directory / "whole", with_episodes(90), 1, Start::fresh, go_on);
  (void)train_into(directory / "part", with_episodes(60), 1, Start::fresh, go_on);
  EXPECT_NE(complaint_of(directory / "part", with_episodes(50), 1, Start::resume)
                .find("run.episodes = 50, but 60 episodes are played"),
            std::string::npos);
  (void)train_into(directory / "part", with_episodes(90), 1, Start::resume, go_on);
  for (const char* name : {"learning_curve.csv", "evaluations.csv"}) {
    EXPECT_EQ(content_of(directory / "part" / name), content_of(directory / "whole" / name)) << name;
  }
  const Model whole = load_model(directory / "whole/model.safetensors");
  const Model part = load_model(directory / "part/model.safetensors");
  EXPECT_EQ(part.parameters, whole.parameters);
  EXPECT_FALSE(whole.metadata.contains("history"));
  EXPECT_EQ(part.metadata.at("history"), "from episode 60 on run.episodes 60 -> 90");
}

TEST(TrainingRun, AnotherLearningRateMayBeResumedWithAndIsNoted) {
  const TemporaryDirectory directory;
  const Config config = some_config();
  const auto run = directory / "run";
  (void)train_into(run, config, 1, Start::fresh, stop_after(20));
  const Config slower = parse_config(config.text, "some.toml", {"optimiser.learning_rate=1e-4"});
  (void)train_into(run, slower, 1, Start::resume, stop_after(40));
  (void)train_into(run, slower, 1, Start::resume, go_on);
  const Model model = load_model(run / "model.safetensors");
  EXPECT_EQ(model.metadata.at("history"), "from episode 20 on optimiser.learning_rate 0.002 -> 0.0001");
  (void)train_into(directory / "plain", config, 1, Start::fresh, go_on);
  EXPECT_FALSE(model.parameters == load_model(directory / "plain/model.safetensors").parameters);
}

TEST(TrainingRun, ItBeginsFromANetwork) {
  const TemporaryDirectory directory;
  const Config config =
      parse_config("[run]\nepisodes = 3\nvalidation_episodes = 0\n[learner]\nwarm_up = 1000\n", "begun.toml");
  const Parameters parameters = some_parameters(7);
  (void)train_into(directory / "run", config, 1, Start::fresh, go_on, &parameters);
  const Model model = load_model(directory / "run/model.safetensors");
  EXPECT_EQ(model.parameters, parameters);  // nothing is learnt before warm_up
  EXPECT_EQ(model.metadata.at("history"), "begun from the network " + model_identity(parameters));
}

// Steps that are far too long, towards values without a discount.
Config diverging_config() {
  return parse_config(
      "[run]\nepisodes = 200\nevaluation_period = 2\nvalidation_episodes = 2\ncheckpoint_period = 3\n"
      "[learner]\nwarm_up = 100\ngradient_steps = 5\ntarget_period = 1\ngamma = 1.0\n"
      "[optimiser]\nlearning_rate = 0.3\n[exploration]\nepsilon_start = 1.0\nepsilon_end = 1.0\n",
      "diverging.toml");
}

// The message says where, and what is sound; the tables end with the last whole episode; no file holds NaN.
TEST(TrainingRun, ADivergedTrainingEndsAndKeepsWhatIsSound) {
  const TemporaryDirectory directory;
  const auto run = directory / "run";
  std::string message;
  try {
    (void)train_into(run, diverging_config(), 1, Start::fresh, go_on);
  } catch (const TrainingDiverged& diverged) {
    message = diverged.what();
  }
  for (const char* part :
       {"is not finite in episode ", "gradient step ", "checkpoint.safetensors is sound, of ",
        "best.safetensors is sound, of ", "--resume", "optimiser.learning_rate (it is 0.3)"}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << ": " << message;
  }
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(run / "model.safetensors"));
  EXPECT_NO_THROW((void)load_model(run / "best.safetensors"));
  EXPECT_NO_THROW((void)read_safetensors(content_of(run / "checkpoint.safetensors"), "checkpoint"));
  const std::string curve = content_of(run / "learning_curve.csv");
  EXPECT_EQ(curve.find("nan"), std::string::npos);
  const auto episode = message.find("episode ") + 8;
  EXPECT_EQ(std::count(curve.begin(), curve.end(), '\n') - 1, std::stoi(message.substr(episode)));
  // The same again from the checkpoint, at the same step.
  try {
    (void)train_into(run, diverging_config(), 1, Start::resume, go_on);
    FAIL() << "it ran";
  } catch (const TrainingDiverged& diverged) {
    EXPECT_EQ(diverged.what(), message);
  }
}

// A file system without room: the error says so, and the checkpoint of before is still whole.
TEST(TrainingRun, AFullDiskKeepsWhatWasThere) {
  const TemporaryDirectory directory;
  const Config config = some_config();
  const auto run = directory / "run";
  (void)train_into(directory / "whole", config, 1, Start::fresh, go_on);
  (void)train_into(run, config, 1, Start::fresh, stop_after(30));
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 4096;
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = complaint_of(run, config, 1, Start::resume);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(message.find(run.string()), std::string::npos) << message;
  EXPECT_EQ(complaint_of(run, config, 1, Start::resume), "it ran");
  expect_same_results(directory, "whole", "run");
}

}  // namespace
}  // namespace striker::training
