// SPDX-License-Identifier: Apache-2.0
// The seam between a task and its learner: an environment that is no kick is played, learnt and evaluated
// alike.
#include "training/task/environment.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "sil/world/random.hpp"
#include "training/learner/dqn.hpp"
#include "training/task/environments.hpp"

namespace striker::training {
namespace {

// On a line, a step to the left (0) or to the right (1): to place 0 from anywhere within 4, at a cost for
// each step.
class LineWalk {
 public:
  struct Outcome {
    double reward = 0.0;
    int finished = 0;
  };

  void reset(std::uint64_t seed, std::uint64_t episode) {
    sil::Random random(seed, episode, 0);
    place_ =
        random.below(2) == 0 ? -1 - static_cast<int>(random.below(4)) : 1 + static_cast<int>(random.below(4));
    outcome_ = {};
    steps_ = 0;
    features_ = Features::Constant(1, static_cast<float>(place_) / 4.0F);
  }
  StepResult step(int action) {
    place_ += action == 1 ? 1 : -1;
    ++steps_;
    features_[0] = static_cast<float>(place_) / 4.0F;
    const double reward = success() ? 1.0 : -0.1;
    outcome_.reward += reward;
    return {
        .reward = reward, .success = success(), .last = steps_ == limit, .end = success() || steps_ == limit};
  }
  void finish() { ++outcome_.finished; }
  [[nodiscard]] bool settled() const { return success() || steps_ == limit; }
  [[nodiscard]] bool success() const { return place_ == 0; }
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  [[nodiscard]] const Features& features() const { return features_; }
  [[nodiscard]] RawState raw() const { return {place_}; }

  static constexpr int limit = 10;

 private:
  int place_ = 0;
  int steps_ = 0;
  Outcome outcome_;
  Features features_{1};
};

static_assert(Environment<LineWalk>);
static_assert(Environment<KickEnvironment>);
static_assert(!Environment<int>);

constexpr std::uint64_t seed = 3;

TEST(Environment, AnEpisodeIsPlayedToItsOutcomeAndFinished) {
  LineWalk walk;
  const auto towards = [](const LineWalk& seen) { return seen.raw()[0] < 0 ? 1 : 0; };
  for (std::uint64_t episode = 0; episode < 20; ++episode) {
    walk.reset(seed, episode);
    const int distance = std::abs(walk.raw()[0]);
    const LineWalk::Outcome outcome = play(walk, seed, episode, towards);
    EXPECT_NEAR(outcome.reward, 1.0 - 0.1 * (distance - 1), 1e-12);
    EXPECT_EQ(outcome.finished, 1);
  }
  EXPECT_NEAR(play(walk, seed, 0, [](const LineWalk& seen) { return seen.raw()[0] < 0 ? 0 : 1; }).reward,
              -0.1 * LineWalk::limit, 1e-12);
}

TEST(Environment, TheLearnerLearnsWhateverItPlays) {
  LearnerSetup setup{.shape = {.inputs = 1, .hidden = {16, 16}, .actions = 2},
                     .learner = {.gamma = 0.9,
                                 .n_step = 1,
                                 .batch = 32,
                                 .replay_size = 5000,
                                 .warm_up = 100,
                                 .target_period = 50,
                                 .target_rate = 1.0,
                                 .gradient_steps = 1},
                     .optimiser = {.learning_rate = 3e-3, .final_fraction = 1.0},
                     .exploration = {.epsilon_start = 1.0, .epsilon_end = 0.1, .decay_episodes = 200},
                     .planned_episodes = 400,
                     .mirror = {}};
  Learner learner(setup, seed);
  LineWalk walk;
  for (int episode = 0; episode < setup.planned_episodes; ++episode) {
    walk.reset(seed, static_cast<std::uint64_t>(episode));
    const EpisodeRow row = learner.play(walk, episode);
    EXPECT_EQ(row.success, walk.success());
    EXPECT_LE(row.decisions, LineWalk::limit);
  }
  const Parameters learnt = learner.result();
  GreedyRule greedy(learnt);
  for (std::uint64_t episode = 1000; episode < 1050; ++episode) {
    walk.reset(seed, episode);
    const int distance = std::abs(walk.raw()[0]);
    EXPECT_NEAR(play(walk, seed, episode, greedy).reward, 1.0 - 0.1 * (distance - 1), 1e-12);
  }
}

TEST(Environment, TheConfigurationsKindIsMade) {
  EXPECT_TRUE(std::holds_alternative<KickEnvironment>(make_environment({.kind = TaskKind::kick})));
}

}  // namespace
}  // namespace striker::training
