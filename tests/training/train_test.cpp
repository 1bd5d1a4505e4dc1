// The learner as a whole.
#include <gtest/gtest.h>

#include "dqn.hpp"
#include "fixtures.hpp"

namespace striker::training {
namespace {

bool go_on(const EpisodeRow& /*row*/) {
  return true;
}

TEST(Train, IsAFunctionOfConfigurationAndSeed) {
  const Config config = short_config(40);
  const Training first = train(config, 1, go_on);
  const Training second = train(config, 1, go_on);
  const Training other = train(config, 2, go_on);
  EXPECT_GT(first.gradient_steps, 500);
  EXPECT_EQ(first.parameters, second.parameters);
  EXPECT_NE(first.parameters, other.parameters);
  ASSERT_EQ(first.rows.size(), second.rows.size());
  for (std::size_t i = 0; i < first.rows.size(); ++i) {
    EXPECT_EQ(first.rows[i].reward, second.rows[i].reward);
    EXPECT_EQ(first.rows[i].loss, second.rows[i].loss);
  }
}

// Every option reaches the learner: switched alone, it changes what is learnt.
TEST(Train, EveryOptionMatters) {
  const Config plain = short_config(25);
  const Parameters learnt = train(plain, 1, go_on).parameters;
  const auto differs = [&](auto change) {
    Config config = plain;
    change(config);
    return train(config, 1, go_on).parameters != learnt;
  };
  EXPECT_TRUE(differs([](Config& c) { c.learner.gamma = 0.9; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.n_step = 1; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.double_dqn = false; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.huber = true; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.mirror = false; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.batch = 32; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.replay_size = 300; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.warm_up = 300; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.target_period = 50; }));
  EXPECT_TRUE(differs([](Config& c) { c.learner.gradient_steps = 2; }));
  EXPECT_TRUE(differs([](Config& c) { c.optimiser.learning_rate = 5e-4; }));
  EXPECT_TRUE(differs([](Config& c) { c.optimiser.final_fraction = 0.1; }));
  EXPECT_TRUE(differs([](Config& c) { c.exploration.epsilon_start = 0.5; }));
  EXPECT_TRUE(differs([](Config& c) { c.exploration.decay_episodes = 30; }));
  EXPECT_TRUE(differs([](Config& c) { c.environments.pop_back(); }));
  EXPECT_TRUE(differs([](Config& c) { c.environments[0].equations = Equations::printed; }));
}

TEST(Train, TheCurveIsTheMovingAverageOfItsRewards) {
  const Training training = train(short_config(300), 3, go_on);
  for (std::size_t i = 0; i < training.rows.size(); ++i) {
    const std::size_t first = i + 1 < 250 ? 0 : i + 1 - 250;
    double sum = 0.0;
    for (std::size_t k = first; k <= i; ++k) {
      sum += training.rows[k].reward;
    }
    ASSERT_NEAR(training.rows[i].moving_average, sum / static_cast<double>(i + 1 - first), 1e-9);
    ASSERT_LE(training.rows[i].steps, sil::kick_decisions);
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
    const Training training = train(config, seed, go_on);
    const Parameters parameters = initial_parameters(seed);
    KickEnv env(config.environments.front());
    const auto played = [&](std::uint64_t episode) {
      return play(env, sil::draw_kick(seed, episode, sil::PoseMode::origin), [&](const RcsState& state) {
        return greedy_action(q_values(parameters, features(state)));
      });
    };
    for (std::size_t i = 0; i < training.rows.size(); ++i) {
      const EpisodeRow& row = training.rows[i];
      const sil::KickOutcome outcome = played(training_episodes + i);
      ASSERT_EQ(row.contact, outcome.contact);
      ASSERT_EQ(row.reward, outcome.reward);
      ASSERT_EQ(row.steps, outcome.contact ? outcome.contact_decision + 1 : sil::kick_decisions);
      contacts += outcome.contact ? 1 : 0;
      unlike_evaluation += row.reward != played(i).reward ? 1 : 0;
    }
  }
  EXPECT_GT(contacts, 5);
  EXPECT_GT(unlike_evaluation, 5);
}

TEST(Train, StopsWhenItIsTold) {
  const Training training =
      train(short_config(1000), 1, [](const EpisodeRow& row) { return row.episode < 7; });
  EXPECT_EQ(training.rows.size(), 8U);
}

TEST(Train, LearnsToKick) {
  Config config = short_config(2000);
  config.learner.replay_size = 100'000;
  config.learner.gamma = 0.98;
  config.learner.target_period = 1000;
  config.exploration.decay_episodes = 800;
  config.validation_episodes = 200;
  const double untrained = validate(config, initial_parameters(1), 1);
  const double trained = validate(config, train(config, 1, go_on).parameters, 1);
  EXPECT_LT(untrained, -2.0);
  EXPECT_GT(trained, 3.0);
}

}  // namespace
}  // namespace striker::training
