// The replay ring and the n-step returns.
#include "replay.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace striker::training {
namespace {

Features numbered(int i) {
  return Features::Constant(static_cast<float>(i));
}

TEST(Replay, KeepsTheNewest) {
  Replay replay(10);
  for (int i = 0; i < 25; ++i) {
    replay.push({.state = numbered(i), .action = i, .reward = 0.0F, .next = numbered(i), .discount = 0.0F});
    EXPECT_EQ(replay.size(), static_cast<std::size_t>(std::min(i + 1, 10)));
  }
  std::vector<bool> held(25, false);
  for (std::size_t i = 0; i < replay.size(); ++i) {
    held[static_cast<std::size_t>(replay[i].action)] = true;
  }
  for (std::size_t i = 0; i < 25; ++i) {
    EXPECT_EQ(held[i], i >= 15);
  }
}

// One transition a step: the discounted sum of up to n rewards, and the state n steps on or the end.
TEST(Replay, NStepReturnsAreTheirDefinition) {
  constexpr double gamma = 0.9;
  const auto reward = [](int t) { return std::sin(3.0 * t) + 0.1 * t; };
  for (const int n : {1, 2, 5, 40}) {
    for (const int length : {1, 3, 5, 12}) {
      Replay replay(100);
      StepFolder folder(n, gamma);
      for (int t = 0; t < length; ++t) {
        folder.take(numbered(t), t % 3, reward(t), numbered(t + 1), t + 1 == length, replay);
      }
      ASSERT_EQ(replay.size(), static_cast<std::size_t>(length));
      for (int t = 0; t < length; ++t) {
        const Transition& transition = replay[static_cast<std::size_t>(t)];
        const int end = std::min(t + n, length);
        double sum = 0.0;
        for (int k = t; k < end; ++k) {
          sum += std::pow(gamma, k - t) * reward(k);
        }
        EXPECT_EQ(transition.state, numbered(t));
        EXPECT_EQ(transition.action, t % 3);
        EXPECT_NEAR(transition.reward, sum, 1e-5);
        EXPECT_NEAR(transition.discount, end == length ? 0.0 : std::pow(gamma, n), 1e-6)
            << n << " " << length;
        EXPECT_EQ(transition.next, numbered(end));
      }
    }
  }
}

}  // namespace
}  // namespace striker::training
