// SPDX-License-Identifier: Apache-2.0
// The replay buffer, the n-step returns and the priorities.
#include "training/learner/replay_buffer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "training/learner/priorities.hpp"

namespace striker::training {
namespace {

constexpr int inputs = 6;

Features numbered(int i) {
  return Features::Constant(inputs, static_cast<float>(i));
}

TEST(ReplayBuffer, KeepsTheNewest) {
  ReplayBuffer replay(inputs, 10);
  for (int i = 0; i < 25; ++i) {
    replay.push({.state = numbered(i), .action = i, .reward = 0.0F, .next = numbered(i), .discount = 0.0F});
    EXPECT_EQ(replay.size(), std::min(i + 1, 10));
  }
  std::vector<bool> held(25, false);
  for (Eigen::Index i = 0; i < replay.size(); ++i) {
    held[static_cast<std::size_t>(replay.action(i))] = true;
  }
  for (std::size_t i = 0; i < 25; ++i) {
    EXPECT_EQ(held[i], i >= 15);
  }
}

// One transition a step: the discounted sum of up to n rewards, and the state n steps on or the end.
TEST(NStep, ReturnsAreTheirDefinition) {
  constexpr double gamma = 0.9;
  const auto reward = [](int t) { return std::sin(3.0 * t) + 0.1 * t; };
  for (const int n : {1, 2, 5, 40}) {
    NStep n_step(n, gamma, inputs);
    for (const int length : {1, 3, 5, 12}) {
      ReplayBuffer replay(inputs, 100);
      for (int t = 0; t < length; ++t) {
        n_step.take(numbered(t), t % 3, reward(t), numbered(t + 1), t + 1 == length,
                    [&replay](const Transition& transition) { replay.push(transition); });
      }
      ASSERT_EQ(replay.size(), length);
      for (int t = 0; t < length; ++t) {
        const int end = std::min(t + n, length);
        double sum = 0.0;
        for (int k = t; k < end; ++k) {
          sum += std::pow(gamma, k - t) * reward(k);
        }
        EXPECT_EQ(replay.state(t), numbered(t));
        EXPECT_EQ(replay.action(t), t % 3);
        EXPECT_NEAR(replay.reward(t), sum, 1e-5);
        EXPECT_NEAR(replay.discount(t), end == length ? 0.0 : std::pow(gamma, n), 1e-6) << n << " " << length;
        EXPECT_EQ(replay.next(t), numbered(end));
      }
    }
  }
}

// At a time limit every open sum ends in the last state, and that keeps its value.
TEST(NStep, ATimeLimitKeepsTheValueOfTheLastState) {
  constexpr double gamma = 0.9;
  constexpr int length = 7;
  for (const int n : {1, 3, 40}) {
    NStep n_step(n, gamma, inputs);
    ReplayBuffer replay(inputs, 100);
    const auto push = [&replay](const Transition& transition) { replay.push(transition); };
    for (int t = 0; t < length; ++t) {
      const bool end = t + 1 == length;
      n_step.take(numbered(t), 0, 1.0, numbered(t + 1), end, push, end);
    }
    ASSERT_EQ(replay.size(), length);
    for (int t = 0; t < length; ++t) {
      const int steps = std::min(n, length - t);
      EXPECT_NEAR(replay.discount(t), std::pow(gamma, steps), 1e-6) << n << " " << t;
      EXPECT_EQ(replay.next(t), numbered(t + steps));
    }
  }
}

// A cut ends every open sum where it is made, and what follows begins anew.
TEST(NStep, ACutEndsTheSums) {
  constexpr double gamma = 0.9;
  constexpr int length = 12;
  constexpr int cut_at = 7;
  NStep n_step(5, gamma, inputs);
  ReplayBuffer replay(inputs, 100);
  const auto push = [&replay](const Transition& transition) { replay.push(transition); };
  for (int t = 0; t < length; ++t) {
    if (t == cut_at) {
      n_step.cut(numbered(t), push);
      ASSERT_EQ(replay.size(), t);
    }
    n_step.take(numbered(t), t % 3, 1.0, numbered(t + 1), t + 1 == length, push);
  }
  ASSERT_EQ(replay.size(), length);
  for (int t = 0; t < length; ++t) {
    const int end = std::min(t + 5, t < cut_at ? cut_at : length);
    EXPECT_EQ(replay.state(t), numbered(t));
    EXPECT_EQ(replay.next(t), numbered(end));
    EXPECT_NEAR(replay.reward(t), (1.0 - std::pow(gamma, end - t)) / (1.0 - gamma), 1e-5);
    EXPECT_NEAR(replay.discount(t), end == length ? 0.0 : std::pow(gamma, end - t), 1e-6);
  }
}

// Places come as often as their priorities say; what was never inserted never comes.
TEST(Priorities, DrawInProportion) {
  constexpr double alpha = 0.5;
  Priorities priorities(100, alpha);
  const std::vector<double> errors = {0.0, 1.0, -4.0, 9.0, 0.25};
  for (std::size_t place = 0; place < errors.size(); ++place) {
    priorities.insert(place);
    EXPECT_GT(priorities.probability(place), 0.0);
  }
  double whole = 0.0;
  for (std::size_t place = 0; place < errors.size(); ++place) {
    priorities.update(place, errors[place]);
    whole += std::pow(std::abs(errors[place]) + 1e-3, alpha);
  }
  constexpr int draws = 100'000;
  std::vector<int> counts(errors.size(), 0);
  for (int i = 0; i < draws; ++i) {
    ++counts.at(priorities.at((i + 0.5) / draws));
  }
  for (std::size_t place = 0; place < errors.size(); ++place) {
    const double expected = std::pow(std::abs(errors[place]) + 1e-3, alpha) / whole;
    EXPECT_NEAR(priorities.probability(place), expected, 1e-6);
    EXPECT_NEAR(static_cast<double>(counts[place]) / draws, expected, 1e-4);
  }
}

// A new one is as urgent as the most urgent so far.
TEST(Priorities, NewOnesComeFirst) {
  Priorities priorities(8, 1.0);
  priorities.insert(0);
  priorities.update(0, 7.0);
  priorities.insert(1);
  EXPECT_NEAR(priorities.probability(1), 0.5, 1e-6);
}

}  // namespace
}  // namespace striker::training
