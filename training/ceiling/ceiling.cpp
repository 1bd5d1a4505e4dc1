// SPDX-License-Identifier: Apache-2.0
#include "training/ceiling/ceiling.hpp"

#include <algorithm>
#include <limits>

namespace striker::training {

namespace {

// What comes of these actions from the start on.
template <typename ActionOf>
FoundSequence played(const LineDrive& drive, const BallTrack& track, const ActionOf& action_of) {
  FoundSequence found;
  LineState robot;
  for (int step = 0; track.begun + step < task_steps; ++step) {
    const int decision = step / steps_per_decision;
    const auto action = static_cast<std::uint8_t>(action_of(decision));
    if (track.depth_m(step, robot.position_m) >= 0.0) {
      found.contact_step = track.begun + step;
      found.reward = contact_reward(drive, track, step, robot, drive.set_points_m_s[action],
                                    -std::numeric_limits<double>::infinity());
      std::fill(found.actions.begin() + decision, found.actions.end(), action);
      break;
    }
    found.actions[static_cast<std::size_t>(decision)] = action;
    advance(robot, drive.set_points_m_s[action], drive.gain_limit_m_s);
  }
  return found;
}

// What the search has to beat: the better, the more branches it cuts. Without any contact the ball must be
// let by: one of the three actions alone does that.
FoundSequence first_guess(const LineDrive& drive, const BallTrack& track, double margin_m) {
  const PlanValue value = best_plan(drive, track, {}, sil::kick_decisions, margin_m);
  if (value.contact && value.reward > no_contact_reward) {
    return played(drive, track, [&](int decision) { return value.plan.action(decision); });
  }
  FoundSequence found;
  for (const int action : {1, 0, 2}) {
    found = played(drive, track, [&](int) { return action; });
    if (found.contact_step < 0) {
      break;
    }
  }
  return found;
}

}  // namespace

CeilingSearch::CeilingSearch(const Reachable& reachable, sil::KickReward reward)
    : reachable_(&reachable), drive_(line_drive(reachable.grid().robot, reward)), cells_(reachable.grid()) {}

// The speed from which on a contact before this step may pay more than `to_beat`.
double CeilingSearch::least_speed_m_s(int step, double to_beat) const {
  const auto n = static_cast<std::size_t>(step);
  if (drive_.reward == sil::KickReward::aimed) {
    return least_speed_for_m_s(drive_.bodies, to_beat, track_.ball(step), waited_until(track_, step));
  }
  const double angle_at_most =
      official.angle_reward * track_.reach_m[n] / std::hypot(track_.reach_m[n], track_.y_m[n]);
  const int waited = track_.decisions_waited(step);
  return (to_beat - official.waiting_reward * waited - angle_at_most) / official.speed_reward_s_m;
}

// From where, and from what speed on, a contact in any later step can be reached that pays more than
// `to_beat`.
CeilingSearch::Needs CeilingSearch::needs(int decision, double to_beat) const {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double most_gain_m_s = drive_.most_gain_m_s();
  Needs needs{.low_m = none, .high_m = -none, .least_speed_m_s = none};
  const int now = decision * steps_per_decision;
  for (int step = std::max(now, track_.first); step < track_.end; ++step) {
    const auto n = static_cast<std::size_t>(step);
    if (track_.reach_m[n] < 0.0) {
      continue;
    }
    const double speed_m_s = least_speed_m_s(step, to_beat);
    if (speed_m_s > drive_.top_speed_m_s) {
      continue;
    }
    const double way_m = drive_.top_speed_m_s * physics_step_s * (step - now);
    needs.low_m = std::min(needs.low_m, track_.x_m[n] - track_.reach_m[n] - way_m);
    needs.high_m = std::max(needs.high_m, track_.x_m[n] + track_.reach_m[n] + way_m);
    needs.least_speed_m_s = std::min(needs.least_speed_m_s, speed_m_s - most_gain_m_s * (step - now));
  }
  return needs;
}

void CeilingSearch::begin(int decision) {
  first_level_ = decision;
  const Needs wanted = needs(decision, ceiling_.safe.reward);
  auto& branches = levels_[static_cast<std::size_t>(decision)];
  branches.clear();
  if (wanted.low_m > wanted.high_m) {
    return;
  }
  const auto all = reachable_->level(decision);
  for (const LineNode& node : reachable_->between(decision, wanted.low_m, wanted.high_m)) {
    if (wanted.met_by(node.state)) {
      branches.push_back({.state = node.state, .parent = static_cast<std::uint32_t>(&node - all.data())});
    }
  }
}

void CeilingSearch::record(FoundSequence& found, Contact& contact, double reward, int step,
                           const Contact& here) const {
  if (reward > found.reward) {
    found.reward = reward;
    found.contact_step = track_.begun + step;
    contact = here;
  }
}

void CeilingSearch::grow(int decision, std::uint32_t index, std::uint8_t action, const Needs& next) {
  Branch branch = levels_[static_cast<std::size_t>(decision)][index];
  branch.parent = index;
  branch.action = action;
  for (int i = 0; i < steps_per_decision; ++i) {
    const int step = decision * steps_per_decision + i;
    const double depth = track_.depth_m(step, branch.state.position_m);
    if (depth >= 0.0) {
      const bool safe = branch.safe && depth > safe_margin_m;
      const double reward = contact_reward(drive_, track_, step, branch.state, drive_.set_points_m_s[action],
                                           safe ? ceiling_.safe.reward : ceiling_.best.reward);
      const Contact here{.level = decision, .branch = index, .action = action};
      record(ceiling_.best, best_, reward, step, here);
      if (safe) {
        record(ceiling_.safe, safe_, reward, step, here);
      }
      return;
    }
    branch.safe = branch.safe && depth < -safe_margin_m;
    advance(branch.state, drive_.set_points_m_s[action], drive_.gain_limit_m_s);
  }
  if (!next.met_by(branch.state)) {
    return;
  }
  auto& branches = levels_[static_cast<std::size_t>(decision) + 1];
  const auto fresh = static_cast<std::uint32_t>(branches.size());
  const std::uint32_t held = cells_.find_or_put(reachable_->grid().cell(branch.state), fresh);
  if (held == fresh) {
    branches.push_back(branch);
  } else if (branch.safe && !branches[held].safe) {
    branches[held] = branch;
  }
}

void CeilingSearch::expand(int decision) {
  const Needs next = needs(decision + 1, ceiling_.safe.reward);
  levels_[static_cast<std::size_t>(decision) + 1].clear();
  cells_.clear();
  const auto count = static_cast<std::uint32_t>(levels_[static_cast<std::size_t>(decision)].size());
  for (std::uint32_t branch = 0; branch < count; ++branch) {
    for (std::size_t action = 0; action < drive_.set_points_m_s.size(); ++action) {
      grow(decision, branch, static_cast<std::uint8_t>(action), next);
    }
  }
}

void CeilingSearch::trace(FoundSequence& found, const Contact& contact) const {
  if (contact.level < 0) {
    return;
  }
  const auto at = static_cast<std::size_t>(contact.level);
  std::fill(found.actions.begin() + contact.level, found.actions.end(), contact.action);
  std::uint32_t branch = contact.branch;
  for (std::size_t level = at; level > static_cast<std::size_t>(first_level_); --level) {
    found.actions[level - 1] = levels_[level][branch].action;
    branch = levels_[level][branch].parent;
  }
  const std::uint32_t node = levels_[static_cast<std::size_t>(first_level_)][branch].parent;
  reachable_->actions_to(first_level_, node, found.actions);
}

Ceiling CeilingSearch::search(const sil::KickStart& start) {
  // A robot whose commands are late stands until its first one acts, and does then what the others do at once: the ball
  // is too far away to touch it before.
  track_ = ball_track(start, described_delays(reachable_->grid().robot).command_steps);
  ceiling_ = {.best = first_guess(drive_, track_, 0.0), .safe = first_guess(drive_, track_, safe_margin_m)};
  best_ = {};
  safe_ = {};
  // The robot must be able to be there by then.
  int first = track_.first;
  const auto out_of_reach = [this](int step) {
    const auto n = static_cast<std::size_t>(step);
    return track_.reach_m[n] < std::abs(track_.x_m[n]) - drive_.top_speed_m_s * physics_step_s * step;
  };
  while (first < track_.end && out_of_reach(first)) {
    ++first;
  }
  if (first < track_.end) {
    const int last_decision = (track_.end - 1) / steps_per_decision;
    begin(first / steps_per_decision);
    for (int decision = first_level_; decision <= last_decision; ++decision) {
      expand(decision);
    }
  }
  trace(ceiling_.best, best_);
  trace(ceiling_.safe, safe_);
  return ceiling_;
}

}  // namespace striker::training
