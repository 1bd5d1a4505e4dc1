// SPDX-License-Identifier: Apache-2.0
#include "training/rollout/guide.hpp"

namespace striker::training {

namespace {

// Four times the cells that the ceiling is searched with: hardly less is found, in a fraction of the time.
LineGrid grid_of(const core::RobotDescription& robot) {
  return {.position_cell_m = 0.020, .speed_cell_m_s = 0.08, .robot = robot};
}

}  // namespace

Guide::Guide(const TaskConfig& task)
    : pose_(task.pose),
      rules_(task.rules),
      reachable_(std::make_shared<const Reachable>(grid_of(task.robot))),
      search_(*reachable_, task.rules.reward) {}

std::string Guide::unfit(const TaskConfig& task) {
  const sil::KickRules& rules = task.rules;
  if (task.actions != kick_actions(task.robot)) {
    return "task.actions: must be forward, stop and backward at top speed: the exact search knows no others";
  }
  if (rules.waiting_reward != official.waiting_reward) {
    return "reward.waiting: must be the default, which the exact search is for";
  }
  if (rules.angle_reward != official.angle_reward) {
    return "reward.angle: must be the default, which the exact search is for";
  }
  if (rules.speed_reward_s_m != official.speed_reward_s_m) {
    return "reward.speed: must be the default, which the exact search is for";
  }
  if (rules.signed_speed != official.signed_speed) {
    return "reward.contact_speed: must be the default, which the exact search is for";
  }
  return "";
}

Guidance Guide::lead(std::uint64_t seed, std::uint64_t number, sil::Random& random) {
  const FoundSequence found = search_.search(sil::draw_kick(seed, number, pose_, rules_)).safe;
  if (found.contact_step < 0) {
    return {};
  }
  const auto contact_decision = static_cast<std::uint64_t>(found.contact_step / steps_per_decision);
  return {.actions = found.actions, .decisions = static_cast<int>(random.below(contact_decision + 1))};
}

}  // namespace striker::training
