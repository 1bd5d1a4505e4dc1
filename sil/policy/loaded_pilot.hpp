// SPDX-License-Identifier: Apache-2.0
// A pilot (firmware/core/pilot.hpp) of a policy that was read at run time: the same decisions, to the bit. A process has
// one such policy, as an image has its own.
//
//   LoadedPilot::fly(policy);                          // before the first of them is made; it outlives them
//   NodeLink<LoadedNode> link(robot);
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "firmware/can/drives/striker_drives.hpp"
#include "firmware/core/controller.hpp"
#include "firmware/core/decision_clock.hpp"
#include "firmware/core/estimation/relative_state.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/supervision/supervisor.hpp"
#include "firmware/loop/controller_node.hpp"
#include "sil/policy/loaded_policy.hpp"

namespace striker::sil {

class LoadedPilot {
 public:
  static inline std::uint32_t identity = 0;

  // The weights lie in this process's own memory, where nothing flips a bit of them.
  struct WeightsCheck {
    [[nodiscard]] static bool step() { return true; }
    std::uint32_t unused = 0;  // sealed state is whole words
  };

  static void fly(const LoadedPolicy& policy);
  [[nodiscard]] static bool suits(const core::RobotProfile& robot);

  [[nodiscard]] core::SelfTest test_self(const core::RobotProfile& robot);
  void reset();
  [[nodiscard]] core::Decision decide(const core::RelativeState& seen, core::DecisionDue due,
                                      std::uint32_t begun_late = 0);
  void end_if(bool ends, core::Decision& decision);

  [[nodiscard]] const core::WheelSpeeds& set_point() const { return set_point_; }
  [[nodiscard]] std::uint32_t decisions() const { return decisions_; }
  [[nodiscard]] std::uint8_t action() const { return static_cast<std::uint8_t>(action_); }

 private:
  void remember(const core::RelativeState& now, bool again);

  static inline const LoadedPolicy* policy_ = nullptr;

  // Whole words, without padding: it is sealed.
  core::SelfTest self_test_ = core::SelfTest::running;
  std::uint32_t self_tested_ = 0;
  std::uint32_t decisions_ = 0;
  std::uint32_t action_ = 0;
  std::uint32_t ended_ = 0;
  core::WheelSpeeds set_point_;
  std::array<core::RelativeState, policy::greatest_look_back + 1> history_{};
};

using LoadedNode = loop::ControllerNode<core::Controller<LoadedPilot>, can::StrikerDrives>;

}  // namespace striker::sil
