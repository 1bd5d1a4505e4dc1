// SPDX-License-Identifier: Apache-2.0
#include "training/rollout/greedy_plays.hpp"

namespace striker::training {

void GreedyPlays::finish(const Parameters& network, std::span<LinePlay> plays) {
  std::vector<std::uint32_t> active;
  for (std::uint32_t i = 0; i < plays.size(); ++i) {
    if (!plays[i].robot.over) {
      active.push_back(i);
    }
  }
  while (!active.empty()) {
    ask(network, plays, active, [&](std::uint32_t number, const auto& /*features*/, const auto& q) {
      LinePlay& play = plays[number];
      play.kick->step(*play.episode, play.robot, greedy_action(q));
      return !play.robot.over;
    });
  }
}

}  // namespace striker::training
