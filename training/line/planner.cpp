// SPDX-License-Identifier: Apache-2.0
#include "training/line/planner.hpp"

#include <algorithm>
#include <cmath>

namespace striker::training {

namespace {

// The fastest action each way, and the one nearest to rest.
struct PlanActions {
  int forward = 0;
  int wait = 0;
  int backward = 0;
};

PlanActions plan_actions(const LineKick& kick) {
  PlanActions best;
  for (int action = 1; action < kick.actions(); ++action) {
    const double speed_m_s = kick.set_point_m_s(action);
    best.forward = speed_m_s > kick.set_point_m_s(best.forward) ? action : best.forward;
    best.backward = speed_m_s < kick.set_point_m_s(best.backward) ? action : best.backward;
    best.wait = std::abs(speed_m_s) < std::abs(kick.set_point_m_s(best.wait)) ? action : best.wait;
  }
  return best;
}

double held_to_the_end(const LineKick& kick, const LineEpisode& episode, LineRobot robot, int action,
                       double to_beat) {
  while (!robot.over) {
    kick.step(episode, robot, action, to_beat);
  }
  return robot.reward;
}

}  // namespace

double plan_reward(const LineKick& kick, const LineEpisode& episode, const LineRobot& robot) {
  const PlanActions actions = plan_actions(kick);
  double best = kick.no_contact_reward();
  const auto hopeless = [&](const LineRobot& at) { return at.over || kick.most_reward(at.decision) <= best; };
  LineRobot reversed = robot;
  for (int reverse = 0; reverse <= most_reverse && !hopeless(reversed); ++reverse) {
    LineRobot waited = reversed;
    while (!hopeless(waited)) {
      best = std::max(best, held_to_the_end(kick, episode, waited, actions.forward, best));
      kick.step(episode, waited, actions.wait, best);
    }
    best = waited.over ? std::max(best, waited.reward) : best;
    kick.step(episode, reversed, actions.backward, best);
  }
  return reversed.over ? std::max(best, reversed.reward) : best;
}

}  // namespace striker::training
