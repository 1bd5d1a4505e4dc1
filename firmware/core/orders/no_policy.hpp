// SPDX-License-Identifier: Apache-2.0
// In the place of a pilot (firmware/core/pilot.hpp) where a robot has no policy of its own: it goes where its team
// orders it, and stands while it is ordered nothing. What a pilot keeps in step with a policy is here a constant.
#pragma once

#include <cstdint>

#include "firmware/core/actions.hpp"
#include "firmware/core/decision_clock.hpp"
#include "firmware/core/estimation/relative_state.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/supervision/supervisor.hpp"

namespace striker::core {

class NoPolicy {
 public:
  static constexpr std::uint32_t identity = 0;

  struct WeightsCheck {
    [[nodiscard]] static bool step() { return true; }
    std::uint32_t unused = 0;  // sealed state is whole words
  };

  [[nodiscard]] static constexpr bool suits(const RobotProfile& robot) { return loops_fit(robot); }
  [[nodiscard]] static SelfTest test_self(const RobotProfile& robot) {
    return suits(robot) ? SelfTest::passed : SelfTest::failed;
  }
  void reset() { decisions_ = 0; }
  [[nodiscard]] Decision decide(const RelativeState&, DecisionDue, std::uint32_t = 0) {
    return {.number = decisions_++, .over = true};
  }
  static void end_if(bool, Decision&) {}
  [[nodiscard]] static WheelSpeeds set_point() { return {}; }
  [[nodiscard]] std::uint32_t decisions() const { return decisions_; }
  [[nodiscard]] static std::uint8_t action() { return 0; }

 private:
  std::uint32_t decisions_ = 0;  // since the reset
};

}  // namespace striker::core
