// SPDX-License-Identifier: Apache-2.0
// The learner from own rollouts as a training: its bytes, its resumption, what it learns, what it refuses.
#include <fmt/format.h>

#include "tests/training/fixtures.hpp"
#include "training/run/directory/train_into.hpp"

namespace striker::training {
namespace {

constexpr const char* small =
    "[run]\nepisodes = 300\nevaluation_period = 100\nvalidation_episodes = 20\ncheckpoint_period = 100\n"
    "[task]\nvelocities = \"both\"\nmirrored = true\n[network]\nhidden = [16, 16]\n"
    "[learner]\nkind = \"rollout\"\nbatch = 64\nwarm_up = 300\nreplay_size = 1500\n"
    "[rollout]\nround = 40\nplanner_episodes = 100\n[optimiser]\naveraging = 0.99\n[exploration]\ndecay_episodes = 200\n";

Config small_config(const std::vector<std::string>& changes = {}) {
  return parse_config(small, "small.toml", changes);
}

TrainingProgress stop_after(int episodes) {
  return [episodes](const CurveRow& row) { return row.episode.episode + 1 < episodes; };
}

bool go_on(const CurveRow& /*row*/) {
  return true;
}

void expect_same_results(const TemporaryDirectory& directory, const std::string& a, const std::string& b) {
  for (const char* name : {"model.safetensors", "best.safetensors", "learning_curve.csv", "evaluations.csv",
                           "checkpoint.safetensors"}) {
    const std::string content = content_of(directory / a / name);
    EXPECT_FALSE(content.empty()) << name;
    EXPECT_TRUE(content == content_of(directory / b / name)) << name;
  }
}

TEST(RolloutTraining, TheSameSeedGivesTheSameBytes) {
  const TemporaryDirectory directory;
  EXPECT_FALSE(train_into(directory / "a", small_config(), 1, Start::fresh, go_on).interrupted);
  (void)train_into(directory / "b", small_config(), 1, Start::fresh, go_on);
  (void)train_into(directory / "other", small_config(), 2, Start::fresh, go_on);
  expect_same_results(directory, "a", "b");
  EXPECT_NE(content_of(directory / "a/model.safetensors"), content_of(directory / "other/model.safetensors"));
}

// A stop takes effect after the round that it falls in; the last round is what is left of 300.
TEST(RolloutTraining, ResumesToTheSameBytes) {
  const TemporaryDirectory directory;
  const TrainingResult whole = train_into(directory / "whole", small_config(), 1, Start::fresh, go_on);
  EXPECT_EQ(whole.episodes, 300);
  EXPECT_GT(whole.gradient_steps, 100);
  for (const int at : {1, 41, 200, 279}) {
    const std::string name = fmt::format("part{}", at);
    const TrainingResult part = train_into(directory / name, small_config(), 1, Start::fresh, stop_after(at));
    EXPECT_TRUE(part.interrupted);
    EXPECT_EQ(part.episodes, (at + 39) / 40 * 40);
    EXPECT_FALSE(train_into(directory / name, small_config(), 1, Start::resume, go_on).interrupted);
    expect_same_results(directory, "whole", name);
  }
}

TEST(RolloutTraining, TheCurveHasARowAnEpisode) {
  const TemporaryDirectory directory;
  (void)train_into(directory / "run", small_config(), 1, Start::fresh, go_on);
  std::istringstream lines(content_of(directory / "run/learning_curve.csv"));
  std::string line;
  std::getline(lines, line);
  int rows = 0;
  for (; std::getline(lines, line); ++rows) {
    EXPECT_EQ(line.find(fmt::format("{},", rows)), 0U) << line;
  }
  EXPECT_EQ(rows, 300);
}

// Every option reaches the learner: switched alone, it changes what is learnt.
TEST(RolloutTraining, EveryOptionMatters) {
  const auto learnt = [](const std::vector<std::string>& changes) {
    Training training(small_config(changes), 1);
    (void)play_all(training);
    return training.result();
  };
  const Parameters plain = learnt({});
  for (const char* change :
       {"rollout.round=50", "rollout.planner_episodes=0", "rollout.longest_hold=2", "rollout.passes=4.0",
        "rollout.focus=1.0", "rollout.pairwise_share=0.9", "rollout.pairwise_rest=0.0",
        "rollout.temperature=1.0", "rollout.greatest_regret=0.5", "rollout.value_weight=0.1",
        "learner.batch=128", "learner.warm_up=1000", "learner.replay_size=500", "optimiser.averaging=0.9",
        "optimiser.learning_rate=1e-3", "exploration.epsilon_end=0.5", "task.mirrored=false",
        "task.velocities=\"true\""}) {
    EXPECT_FALSE(plain == learnt({change})) << change;
  }
}

// Three thousand episodes of a small network: more than the best scripted rival gets but for the planner (6.92).
TEST(RolloutTraining, LearnsToKick) {
  Training training(
      small_config({"run.episodes=6000", "run.validation_episodes=2000", "network.hidden=[48, 48]",
                    "rollout.round=200", "rollout.planner_episodes=2000", "learner.replay_size=60000",
                    "exploration.decay_episodes=1500", "optimiser.averaging=0.99", "learner.batch=128"}),
      1);
  (void)play_all(training);
  EXPECT_GT(validation_mean(training, training.result()), 6.5);
}

// Greedy play is worth what the greatest output says.
TEST(RolloutTraining, TheOutputsAreValues) {
  Training training(
      small_config({"run.episodes=6000", "network.hidden=[48, 48]", "rollout.round=200",
                    "rollout.planner_episodes=2000", "learner.replay_size=60000", "rollout.value_weight=0.1",
                    "exploration.decay_episodes=1500", "learner.batch=128"}),
      1);
  (void)play_all(training);
  const Parameters network = training.result();
  KickEnvironment env(training.config().environments.front());
  GreedyRule greedy(network);
  Actor actor(network.shape());
  double error = 0.0;
  double spread = 0.0;
  for (std::uint64_t number = 0; number < 500; ++number) {
    env.reset(1, number);
    const auto value = static_cast<double>(actor.values(network, env.features()).maxCoeff());
    const double reward = play(env, 1, number, greedy).reward;
    error += std::abs(value - reward) / 500.0;
    spread += std::abs(7.0 - reward) / 500.0;
  }
  EXPECT_LT(error, 0.8 * spread);
}

}  // namespace
}  // namespace striker::training
