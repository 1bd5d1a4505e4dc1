// SPDX-License-Identifier: Apache-2.0
#include "sil/policy/loaded_pilot.hpp"

#include <algorithm>
#include <vector>

namespace striker::sil {

namespace {

// The best of the others.
std::int32_t runner_up(std::vector<std::int32_t> sums, std::uint8_t action) {
  sums.erase(sums.begin() + action);
  return *std::ranges::max_element(sums);
}

}  // namespace

void LoadedPilot::fly(const LoadedPolicy& policy) {
  policy_ = &policy;
  identity = policy.identity;
}

bool LoadedPilot::suits(const core::RobotProfile& robot) {
  const std::int32_t top_mm_s = robot.top_rim_speed_mm_s;
  return core::loops_fit(robot) &&
         std::ranges::all_of(policy_->set_points, [top_mm_s](const policy::WheelSetPoint& action) {
           return std::max(action.left_mm_s, action.right_mm_s) <= top_mm_s &&
                  std::min(action.left_mm_s, action.right_mm_s) >= -top_mm_s;
         });
}

// In as many ticks as the compiled one; the golden vectors were tried when the policy was read.
core::SelfTest LoadedPilot::test_self(const core::RobotProfile& robot) {
  if (self_test_ == core::SelfTest::running) {
    if (!suits(robot)) {
      self_test_ = core::SelfTest::failed;
    } else if (++self_tested_ == policy_->golden_vectors.size()) {
      self_test_ = core::SelfTest::passed;
    }
  }
  return self_test_;
}

void LoadedPilot::reset() {
  decisions_ = 0;
  ended_ = 0;
  history_ = {};
  set_point_ = {};
}

core::Decision LoadedPilot::decide(const core::RelativeState& seen, core::DecisionDue due,
                                   std::uint32_t begun_late) {
  const bool again = due == core::DecisionDue::again && decisions_ > 0;
  decisions_ -= again ? 1U : 0U;
  core::RelativeState now = seen;
  now.decisions_left =
      std::max(policy::decisions_a_kick - static_cast<std::int32_t>(decisions_ + begun_late), 0);
  remember(now, again);
  const bool mirror = policy_->mirrored && now.ball_um.y < 0;
  std::vector<std::int32_t> inputs;
  for (const auto& [element, ago] : policy_->state) {
    const std::int32_t value = core::element_of(history_[ago], element);
    inputs.push_back(mirror && policy::changes_sign(element) ? -value : value);
  }
  const std::vector<std::int32_t> sums = sums_of(*policy_, inputs);
  const std::uint8_t action = choice_of(sums);
  action_ = action;
  const bool over = ended_ != 0 || decisions_ >= policy::decisions_a_kick;
  const auto& [left_mm_s, right_mm_s] = policy_->set_points[action];
  set_point_ = over     ? core::WheelSpeeds{}
               : mirror ? core::WheelSpeeds{right_mm_s, left_mm_s}
                        : core::WheelSpeeds{left_mm_s, right_mm_s};
  const int shift = policy_->layers.back().shift;
  return {.number = decisions_++,
          .action = action,
          .extrapolated = due == core::DecisionDue::extrapolated || due == core::DecisionDue::provisional,
          .provisional = due == core::DecisionDue::provisional,
          .over = over,
          .best_q_256th = sums[action] >> shift,
          .next_q_256th = runner_up(sums, action) >> shift};
}

void LoadedPilot::end_if(bool ends, core::Decision& decision) {
  if (ends) {
    ended_ = 1;
    set_point_ = {};
    decision.over = true;
  }
}

void LoadedPilot::remember(const core::RelativeState& now, bool again) {
  if (decisions_ == 0) {
    history_.fill(now);
    return;
  }
  if (!again) {
    std::shift_right(history_.begin(), history_.end(), 1);
  }
  history_.front() = now;
}

}  // namespace striker::sil
