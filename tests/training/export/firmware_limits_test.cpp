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

TEST(FirmwareLimits, ANetworkThatNoCompilerTakesIsNamed) {
  EXPECT_NO_THROW(require_header_compiles({}));
  EXPECT_NO_THROW(require_header_compiles({.hidden = {256, 256, 256}}));
  EXPECT_NO_THROW(require_header_compiles({.inputs = 1, .hidden = {80'000}, .actions = 1}));
  try {
    require_header_compiles({.hidden = {700, 700}});
    FAIL() << "it was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "the network 6-700-700-3 has 496300 weights, and the firmware's compilers take 160000 at "
                 "most; train with a smaller network.hidden");
  }
  EXPECT_THROW(require_header_compiles({.inputs = 1, .hidden = {80'001}, .actions = 1}), std::runtime_error);
  EXPECT_THROW(require_header_compiles({.hidden = {100'000, 100'000, 100'000}}), std::runtime_error);
}

}  // namespace
}  // namespace striker::training
