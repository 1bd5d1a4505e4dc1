// SPDX-License-Identifier: Apache-2.0
#include "training/rollout/robots.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "sil/task/mean_estimate.hpp"
#include "training/line/planner.hpp"
#include "training/rollout/greedy_plays.hpp"

namespace striker::training {

namespace {

std::vector<LineEpisode> drawn(const Conditions& conditions, const LineKick& kick,
                               const PlayedEpisodes& played) {
  std::vector<LineEpisode> episodes;
  episodes.reserve(static_cast<std::size_t>(played.episodes));
  for (int i = 0; i < played.episodes; ++i) {
    episodes.push_back(kick.draw(played.seed, played.first + static_cast<std::uint64_t>(i), conditions));
  }
  return episodes;
}

std::vector<double> greedy_rewards_of(const std::vector<LineEpisode>& episodes, const LineKick& kick,
                                      const Parameters& network) {
  std::vector<LinePlay> plays;
  plays.reserve(episodes.size());
  for (const LineEpisode& episode : episodes) {
    plays.push_back({.kick = &kick, .episode = &episode, .robot = {}});
  }
  GreedyPlays(network.shape()).finish(network, plays);
  std::vector<double> rewards;
  rewards.reserve(plays.size());
  for (const LinePlay& play : plays) {
    rewards.push_back(play.robot.reward);
  }
  return rewards;
}

}  // namespace

std::vector<double> greedy_rewards(const Conditions& conditions, const LineKick& kick,
                                   const Parameters& network, const PlayedEpisodes& played) {
  return greedy_rewards_of(drawn(conditions, kick, played), kick, network);
}

double planned_reward(const LineKick& kick, const LineEpisode& episode) {
  LineRobot robot;
  while (!robot.over) {
    LineRobot best;
    double best_reward = -std::numeric_limits<double>::infinity();
    for (int action = 0; action < kick.actions(); ++action) {
      LineRobot next = robot;
      kick.step(episode, next, action);
      const double reward = next.over ? next.reward : plan_reward(kick, episode, next);
      if (reward > best_reward) {
        best = next;
        best_reward = reward;
      }
    }
    robot = best;
  }
  return robot.reward;
}

RobotScore score_on(const Conditions& conditions, const LineKick& kick, const Parameters& network,
                    const PlayedEpisodes& played) {
  const std::vector<LineEpisode> episodes = drawn(conditions, kick, played);
  std::vector<double> planned;
  planned.reserve(episodes.size());
  for (const LineEpisode& episode : episodes) {
    planned.push_back(planned_reward(kick, episode));
  }
  return {.conditions = conditions,
          .network = sil::mean_estimate(greedy_rewards_of(episodes, kick, network)).mean,
          .planner = sil::mean_estimate(planned).mean,
          .no_contact = kick.no_contact_reward()};
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto place = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  return values[std::min(place, values.size() - 1)];
}

}  // namespace striker::training
