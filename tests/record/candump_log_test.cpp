// SPDX-License-Identifier: Apache-2.0
#include "sil/record/candump_log.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "firmware/host/files.hpp"

namespace striker::sil {
namespace {

const std::filesystem::path file = std::filesystem::temp_directory_path() / "striker_candump_log_test.log";

TEST(CandumpLog, AFrameALineWithItsStampAndItsRobotsBus) {
  const std::array<StampedFrame, 2> zeroth = {
      StampedFrame{{.id = 0x050, .length = 8, .data = {0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88}},
                   12'345'000'999},
      StampedFrame{{0x7FF, 0, {}}, 12'345'001'000}};
  const std::array<StampedFrame, 1> first = {
      StampedFrame{{.id = 0x00A, .length = 2, .data = {0x0A, 0xF0}}, 0}};
  const std::array robots = {RobotSnapshot{.pose = {}, .velocity_m_s = {}, .frames = zeroth},
                             RobotSnapshot{.pose = {}, .velocity_m_s = {}, .frames = first}};
  CandumpLog log(file);
  log.end_tick({.robots = robots, .ball = {}});
  EXPECT_FALSE(std::filesystem::exists(file)) << "a run that is not over has no log";
  log.end_run();
  EXPECT_EQ(host::read_file(file),
            "(0000000012.345000) vcan0 050#1122334455667788\n"
            "(0000000012.345001) vcan0 7FF#\n"
            "(0000000000.000000) vcan1 00A#0AF0\n");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace striker::sil
