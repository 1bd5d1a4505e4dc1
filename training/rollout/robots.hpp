// SPDX-License-Identifier: Apache-2.0
// What a network is worth on robots that are not the nominal one, beside a planner that knows the true robot, ball and
// camera: the network is told nothing of them.
//
//   const LineKick kick(task);
//   const RobotScore heavy = score_on({.mass_scale = 1.3}, kick, network, {.seed = 1, .episodes = 2000});
//   heavy.share()   // 0.99: the network gets 99 % of the planner's way from no contact
//
// Both play the same episodes. The planner costs some 2 ms an episode, the network a hundredth of that.
#pragma once

#include <cstdint>
#include <vector>

#include "sil/world/random.hpp"
#include "training/learner/network.hpp"
#include "training/line/line_episode.hpp"

namespace striker::training {

struct PlayedEpisodes {
  std::uint64_t seed = 0;
  std::uint64_t first = 0;
  int episodes = 1;
};

struct RobotScore {
  Conditions conditions;
  double network = 0.0;  // mean rewards
  double planner = 0.0;
  double no_contact = 0.0;

  // Of the planner's way from an episode without contact. The planner has a contact in some episode.
  [[nodiscard]] double share() const { return (network - no_contact) / (planner - no_contact); }
};

[[nodiscard]] RobotScore score_on(const Conditions& conditions, const LineKick& kick,
                                  const Parameters& network, const PlayedEpisodes& played);

// The reward of each episode of greedy play by the network.
[[nodiscard]] std::vector<double> greedy_rewards(const Conditions& conditions, const LineKick& kick,
                                                 const Parameters& network, const PlayedEpisodes& played);

// The reward of an episode in which each decision is the best by the planner (planner.hpp).
[[nodiscard]] double planned_reward(const LineKick& kick, const LineEpisode& episode);

// Of values between 0 and 1, the one that a share of them do not reach: quantile(0.5) is the median. Not of none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

}  // namespace striker::training
