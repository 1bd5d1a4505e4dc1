// SPDX-License-Identifier: Apache-2.0
// A policy at work: from where the ball is to where the wheels are to go, once a decision.
//
// `policy` is a constant with static storage, as an exported header holds (firmware/policy/policy.hpp). The
// compiler refuses one that could overflow, that was altered after its export, or that this controller cannot
// feed. One image may hold several pilots; each is a plain value, without statics, and copies go on alone.
//
//   Pilot<policy::kick> pilot;
//   const Decision decision = pilot.decide(relative_state(estimator.at(tick, odometry)), DecisionDue::on_picture);
//   loops.step(robot, pilot.set_point(), measured);
//
// A kick has `decisions_a_kick` decisions, as many as it was trained for, unless it ends before the field's border.
// After them the wheels are told to stand, until the next arming begins another one.
//
// Cost: a decision is one forward pass, whose instruction count does not depend on the input.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "firmware/core/actions.hpp"
#include "firmware/core/decision_clock.hpp"
#include "firmware/core/estimation/relative_state.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/supervision/supervisor.hpp"
#include "firmware/core/tick.hpp"
#include "firmware/policy/network.hpp"
#include "firmware/policy/proof.hpp"
#include "firmware/policy/weights_check.hpp"

namespace striker::core {

template <const auto& policy>
class Pilot {
  using Shape = std::remove_cvref_t<decltype(policy)>;

  static_assert(policy::scales_are_valid(policy),
                "STRIKER POLICY: a shift, a multiplier or the period is out of range");
  static_assert(policy::sums_fit(policy),
                "STRIKER POLICY: a 32-bit sum could overflow: export the model again");
  static_assert(policy::identity_of(policy) == policy.identity,
                "STRIKER POLICY: the header was altered after its export: export the model again");
  static_assert(policy.decision_period_ms == decision_period_ms,
                "STRIKER POLICY: trained at another decision period than this controller's 50 ms");
  static_assert(policy::inputs_are_known(policy),
                "STRIKER POLICY: an input that this controller does not compute, or too many of them");
  static_assert(Shape::goldens >= 1, "STRIKER POLICY: no golden vector to test the boot with");

 public:
  static constexpr std::uint32_t identity = policy.identity;
  using WeightsCheck = policy::WeightsCheck<policy>;

  // What the network reads, in the order of its inputs, and where its actions send the wheels. Copies: what
  // is read at run time must not bring the header's weights into the image, where the kernel's own are.
  static constexpr auto state = policy.state;
  static constexpr auto set_points = policy.set_points;
  using Inputs = std::array<std::int32_t, Shape::inputs>;

  // No action goes beyond the robot's top speed, and its wheel loops stay within 32 bits: a constant expression
  // where the robot is known to the compiler, and a part of the self-test everywhere.
  [[nodiscard]] static constexpr bool suits(const RobotProfile& robot) {
    if (!loops_fit(robot)) {
      return false;
    }
    for (const policy::WheelSetPoint& action : set_points) {
      if (std::max(action.left_mm_s, action.right_mm_s) > robot.top_rim_speed_mm_s ||
          std::min(action.left_mm_s, action.right_mm_s) < -robot.top_rim_speed_mm_s) {
        return false;
      }
    }
    return true;
  }

  // One golden vector a tick, so that no tick is longer than one with a decision.
  [[nodiscard]] SelfTest test_self(const RobotProfile& robot) {
    if (self_test_ == SelfTest::running) {
      const auto& golden = golden_vectors[self_tested_];
      const auto q = policy::infer<policy>(golden.raw);
      if (q.sums != golden.sums || q.action != golden.action || !suits(robot)) {
        self_test_ = SelfTest::failed;
      } else if (++self_tested_ == Shape::goldens) {
        self_test_ = SelfTest::passed;
      }
    }
    return self_test_;
  }

  // At arming: the next decision is number 0, and nothing came before it.
  void reset() {
    decisions_ = 0;
    ended_ = 0;
    history_ = {};
    set_point_ = {};
  }

  // One that is made again takes the last one's place, number and history with it. What is seen is led to when the
  // decision acts, and so is the count: `begun_late` decisions have passed by then.
  [[nodiscard]] Decision decide(const RelativeState& seen, DecisionDue due, std::uint32_t begun_late = 0) {
    const bool again = due == DecisionDue::again && decisions_ > 0;
    decisions_ -= again ? 1U : 0U;
    RelativeState now = seen;
    const auto made =
        static_cast<std::int32_t>(std::min<std::uint32_t>(decisions_ + begun_late, policy::decisions_a_kick));
    now.decisions_left = policy::decisions_a_kick - made;
    remember(now, again);
    const bool mirror = one_sided && now.ball_um.y < 0;
    read_inputs(mirror);
    const auto q = policy::infer<policy>(inputs_);
    action_ = q.action;
    const bool over = ended_ != 0 || decisions_ >= policy::decisions_a_kick;
    set_point_ = over ? WheelSpeeds{} : set_point_of(q.action, mirror);
    return {.number = decisions_++,
            .action = q.action,
            .extrapolated = due == DecisionDue::extrapolated || due == DecisionDue::provisional,
            .provisional = due == DecisionDue::provisional,
            .over = over,
            .best_q_256th = q.sums[q.action] >> output_shift,
            .next_q_256th = runner_up(q) >> output_shift};
  }

  // The kick is over with this decision.
  void end_if(bool ends, Decision& decision) {
    if (ends) {
      ended_ = 1;
      set_point_ = {};
      decision.over = true;
    }
  }

  // Of the last decision; 0 before the first, and when the kick is over.
  [[nodiscard]] const WheelSpeeds& set_point() const { return set_point_; }

  // Since the reset; and the last one's action.
  [[nodiscard]] std::uint32_t decisions() const { return decisions_; }
  [[nodiscard]] std::uint8_t action() const { return static_cast<std::uint8_t>(action_); }

  // What the network read in the last decision, for telemetry and tests.
  [[nodiscard]] const Inputs& inputs() const { return inputs_; }

 private:
  static constexpr auto golden_vectors = policy.golden_vectors;
  static constexpr bool one_sided = policy.mirrored;
  static constexpr auto flips = [] {  // in a mirror along the heading
    std::array<bool, Shape::inputs> changes{};
    for (std::size_t i = 0; i < changes.size(); ++i) {
      changes[i] = policy::changes_sign(policy.state[i].element);
    }
    return changes;
  }();
  static constexpr int output_shift = policy.output.shift;
  static constexpr std::size_t look_back = [] {
    std::size_t furthest = 0;
    for (const policy::StateInput& input : policy.state) {
      furthest = std::max<std::size_t>(furthest, input.decisions_ago);
    }
    return furthest;
  }();

  // Before the first decision everything was as at the first.
  void remember(const RelativeState& now, bool again) {
    if (decisions_ == 0) {
      history_.fill(now);
      return;
    }
    if (!again) {
      std::copy_backward(history_.begin(), history_.end() - 1, history_.end());
    }
    history_.front() = now;
  }

  [[nodiscard]] static WheelSpeeds set_point_of(std::size_t action, bool mirror) {
    const policy::WheelSetPoint& wanted = set_points[action];
    return mirror ? WheelSpeeds{wanted.right_mm_s, wanted.left_mm_s}
                  : WheelSpeeds{wanted.left_mm_s, wanted.right_mm_s};
  }

  void read_inputs(bool mirror) {
    for (std::size_t i = 0; i < Shape::inputs; ++i) {
      const std::int32_t value = element_of(history_[state[i].decisions_ago], state[i].element);
      inputs_[i] = mirror && flips[i] ? -value : value;
    }
  }

  // The best Q among the actions other than the chosen one, still in the output layer's scale.
  [[nodiscard]] static std::int32_t runner_up(const policy::QValues<Shape::actions>& q) {
    std::int32_t best = q.sums[q.action == 0 ? 1 : 0];
    for (std::size_t k = 0; k < Shape::actions; ++k) {
      best = k == q.action ? best : std::max(best, q.sums[k]);
    }
    return best;
  }

  SelfTest self_test_ = SelfTest::running;
  std::uint32_t self_tested_ = 0;  // golden vectors that passed
  std::uint32_t decisions_ = 0;    // since the reset
  std::uint32_t action_ = 0;       // a whole word: it is sealed
  std::uint32_t ended_ = 0;        // another
  WheelSpeeds set_point_;
  Inputs inputs_{};
  std::array<RelativeState, look_back + 1> history_{};  // of the decisions, the newest first
};

}  // namespace striker::core
