// SPDX-License-Identifier: Apache-2.0
// What no controller could run is refused before it is exported, in words.
#include "training/export/firmware_limits.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace striker::training {
namespace {

std::string complaint_about(const TaskConfig& task) {
  try {
    require_firmware_serves(task);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "served";
}

TEST(FirmwareLimits, TheOfficialTaskIsServed) {
  EXPECT_EQ(complaint_about({}), "served");
}

TEST(FirmwareLimits, ASetPointBeyondTheRobotIsNamed) {
  TaskConfig task;
  task.actions[1] = {.left_m_s = 0.5, .right_m_s = -2.551};
  const std::string message = complaint_about(task);
  EXPECT_NE(message.find("task.actions[1] = [0.5, -2.551]"), std::string::npos) << message;
  EXPECT_NE(message.find("2.55 m/s"), std::string::npos) << message;
  task.actions[1].right_m_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(complaint_about(task), "served");
}

TEST(FirmwareLimits, TheLimitIsTheRobots) {
  EXPECT_EQ(complaint_about({.robot = core::goalkeeper}), "served");
  const std::string message = complaint_about({.robot = core::goalkeeper, .actions = kick_actions()});
  EXPECT_NE(message.find("task.actions[0] = [2.55, 2.55]: a wheel of the robot reaches 1.8 m/s"),
            std::string::npos)
      << message;
}

TEST(FirmwareLimits, WhatTheControllerDoesNotComputeIsNamed) {
  EXPECT_NE(complaint_about({.equations = Equations::printed}).find("printed"), std::string::npos);
  EXPECT_NE(complaint_about({.inputs = acs_inputs()}).find("field_robot_x"), std::string::npos);
  EXPECT_NE(complaint_about({.inputs = StateInputs(33)}).find("33 inputs"), std::string::npos);
}

}  // namespace
}  // namespace striker::training
