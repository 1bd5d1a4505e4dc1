// SPDX-License-Identifier: Apache-2.0
// A network beside a planner on other robots: the figures are those of other ways to the same play.
#include "training/rollout/robots.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "training/learner/dqn.hpp"
#include "training/run/evaluation.hpp"

namespace striker::training {
namespace {

constexpr PlayedEpisodes few = {.seed = 5, .first = 3, .episodes = 60};

TaskConfig exact_task() {
  return {};
}

TEST(Robots, TheNominalRobotsPlayIsTheEnvironments) {
  const TaskConfig task = exact_task();
  const Parameters network = initial_parameters(Shape{}, 7);
  const std::vector<double> rewards = greedy_rewards({}, LineKick(task), network, few);
  double sum = 0.0;
  for (const double reward : rewards) {
    sum += reward;
  }
  EXPECT_NEAR(sum / few.episodes, mean_reward(task, network, few.seed, few.first, few.episodes), 1e-9);
  EXPECT_NEAR(score_on({}, LineKick(task), network, few).network, sum / few.episodes, 1e-12);
}

// It looks ahead from every decision, and so gets no less than any action that is held to the end.
TEST(Robots, ThePlannerBeatsEveryHeldActionOnEveryRobot) {
  const LineKick kick(exact_task());
  for (const Conditions& robot : {Conditions{}, Conditions{.mass_scale = 1.3, .friction_scale = 0.5},
                                  Conditions{.command_delay_steps = 4}}) {
    for (std::uint64_t number = 0; number < 60; ++number) {
      const LineEpisode episode = kick.draw(5, number, robot);
      const double planned = planned_reward(kick, episode);
      for (int action = 0; action < kick.actions(); ++action) {
        LineRobot held;
        while (!held.over) {
          kick.step(episode, held, action);
        }
        EXPECT_GE(planned, held.reward - 1e-9) << number << ' ' << action;
      }
    }
  }
}

TEST(Robots, AWeakRobotGetsLessThanANominalOneAndAStrongOneMore) {
  const LineKick kick(exact_task());
  const Parameters network = initial_parameters(Shape{}, 7);
  const double weak = score_on({.torque_scale = 0.7}, kick, network, few).planner;
  const double nominal = score_on({}, kick, network, few).planner;
  const double strong = score_on({.torque_scale = 1.3}, kick, network, few).planner;
  EXPECT_LT(weak, nominal);
  EXPECT_LT(nominal, strong);
}

TEST(Robots, TheShareIsOfTheWayFromNoContact) {
  const RobotScore score = {.conditions = {}, .network = 5.0, .planner = 8.0, .no_contact = -4.0};
  EXPECT_DOUBLE_EQ(score.share(), 0.75);
}

TEST(Robots, AQuantileIsOneOfTheValues) {
  std::vector<double> values;
  for (int i = 100; i > 0; --i) {
    values.push_back(i / 100.0);
  }
  EXPECT_DOUBLE_EQ(quantile(values, 0.0), 0.01);
  EXPECT_DOUBLE_EQ(quantile(values, 0.1), 0.11);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 0.51);
  EXPECT_DOUBLE_EQ(quantile(values, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile({0.3}, 0.5), 0.3);
}

}  // namespace
}  // namespace striker::training
