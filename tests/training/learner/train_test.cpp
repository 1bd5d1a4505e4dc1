// SPDX-License-Identifier: Apache-2.0
// The learner as a whole.
#include <gtest/gtest.h>

#include "tests/training/fixtures.hpp"
#include "training/run/evaluation.hpp"
#include "training/run/training_run.hpp"
#include "training/task/episode_numbers.hpp"

namespace striker::training {
namespace {

Parameters learnt(const Config& config, std::uint64_t seed) {
  Training training(config, seed);
  play_all(training);
  return training.result();
}

TEST(Train, IsAFunctionOfConfigurationAndSeed) {
  const Config config = short_config(40);
  Training first(config, 1);
  Training second(config, 1);
  for (int i = 0; i < config.run.episodes; ++i) {
    const CurveRow a = first.play_round().front();
    const CurveRow b = second.play_round().front();
    EXPECT_EQ(a.episode.reward, b.episode.reward);
    EXPECT_EQ(a.episode.loss, b.episode.loss);
    EXPECT_EQ(a.episode.q, b.episode.q);
  }
  EXPECT_GT(first.gradient_steps(), 500);
  EXPECT_EQ(first.result(), second.result());
  EXPECT_FALSE(first.result() == learnt(config, 2));
}

// Every option reaches the learner: switched alone, it changes what is learnt.
TEST(Train, EveryOptionMatters) {
  const Config plain = short_config(25);
  const Parameters without = learnt(plain, 1);
  const auto differs = [&](auto change) {
    Config config = plain;
    change(config);
    return !(learnt(config, 1) == without);
  };
  EXPECT_TRUE(differs([](Config& c) { c.shape.hidden[0] = 32; }));
  EXPECT_TRUE(differs([](Config& c) { c.shape.dueling = true; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.gamma = 0.9; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.n_step = 1; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.cut_at_exploration = true; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.time_limit = true; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.double_dqn = false; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.huber = true; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.augment_mirrored = false; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.batch = 32; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.replay_size = 300; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.warm_up = 300; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.target_period = 50; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.target_rate = 0.5; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.gradient_steps = 2; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.clip_norm = 0.1; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.int8_weights = true; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.prioritised = true; }));
  EXPECT_TRUE(differs([](Config& c) { c.optimiser.learning_rate = 5e-4; }));
  EXPECT_TRUE(differs([](Config& c) { c.optimiser.final_fraction = 0.1; }));
  EXPECT_TRUE(differs([](Config& c) { c.optimiser.averaging = 0.99; }));
  EXPECT_TRUE(differs([](Config& c) { c.exploration.epsilon_start = 0.5; }));
  EXPECT_TRUE(differs([](Config& c) { c.exploration.decay_episodes = 30; }));
  EXPECT_TRUE(differs([](Config& c) { c.environments.pop_back(); }));
  EXPECT_TRUE(differs([](Config& c) { c.environments[0].equations = Equations::printed; }));
}

// The options of an option matter where it is on.
TEST(Train, PrioritiesAndSchedulesMatter) {
  Config plain = short_config(25);
  plain.learner.prioritised = true;
  plain.optimiser.final_fraction = 0.1;
  plain.exploration.epsilon_end = 0.1;
  plain.exploration.decay_episodes = 25;
  const Parameters without = learnt(plain, 1);
  const auto differs = [&](auto change) {
    Config config = plain;
    change(config);
    return !(learnt(config, 1) == without);
  };
  EXPECT_TRUE(differs([](Config& c) { c.learner.priority_exponent = 0.3; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.priority_correction = 0.9; }));
  EXPECT_TRUE(differs([](Config& c) { c.optimiser.schedule = Course::cosine; }));
  EXPECT_TRUE(differs([](Config& c) { c.exploration.schedule = Course::exponential; }));
}

TEST(Train, TheCurveIsTheMovingAverageOfItsRewards) {
  Training training(short_config(300), 3);
  const std::vector<CurveRow> rows = play_all(training);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t first = i + 1 < 250 ? 0 : i + 1 - 250;
    double sum = 0.0;
    for (std::size_t k = first; k <= i; ++k) {
      sum += rows[k].episode.reward;
    }
    ASSERT_NEAR(rows[i].moving_average, sum / static_cast<double>(i + 1 - first), 1e-9);
    ASSERT_LE(rows[i].episode.decisions, sil::kick_decisions);
  }
}

// Without exploration and learning, training is greedy play with the initial weights: on its own episodes,
// which no evaluation meets, and up to the contact.
TEST(Train, PlaysItsOwnEpisodesUpToTheContact) {
  Config config = short_config(60);
  config.environments.pop_back();
  config.exploration = {.epsilon_start = 0.0, .epsilon_end = 0.0, .decay_episodes = 1};
  config.learner.gradient_steps = 0;
  int contacts = 0;
  int unlike_evaluation = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Training training(config, seed);
    const Parameters parameters = initial_parameters(config.shape, seed);
    KickEnvironment env(config.environments.front());
    GreedyRule greedy(parameters);
    const auto played = [&](std::uint64_t episode) { return play(env, seed, episode, greedy); };
    for (std::uint64_t i = 0; !training.done(); ++i) {
      const EpisodeRow row = training.play_round().front().episode;
      const sil::KickOutcome outcome = played(first_training_episode + i);
      ASSERT_EQ(row.success, outcome.contact);
      ASSERT_EQ(row.reward, outcome.reward);
      ASSERT_EQ(row.decisions, outcome.contact ? outcome.contact_decision + 1 : sil::kick_decisions);
      contacts += outcome.contact ? 1 : 0;
      unlike_evaluation += row.reward != played(i).reward ? 1 : 0;
    }
  }
  EXPECT_GT(contacts, 5);
  EXPECT_GT(unlike_evaluation, 5);
}

TEST(Train, LearnsToKick) {
  Config config = short_config(2000);
  config.learner.replay_size = 100'000;
  config.learner.gamma = 0.98;
  config.learner.target_period = 1000;
  config.exploration.decay_episodes = 800;
  const TaskConfig& task = config.environments.front();
  const double untrained =
      mean_reward(task, initial_parameters(config.shape, 1), 1, first_validation_episode, 200);
  const double trained = mean_reward(task, learnt(config, 1), 1, first_validation_episode, 200);
  EXPECT_LT(untrained, -2.0);
  EXPECT_GT(trained, 3.0);
}

}  // namespace
}  // namespace striker::training
