// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/description/robot_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace striker::sil {
namespace {

TEST(RobotFile, TheThreeRolesAreThoseOfTheFirmware) {
  const std::filesystem::path folder = STRIKER_ROBOTS;
  EXPECT_EQ(read_robot(folder / "forward.toml"), core::forward);
  EXPECT_EQ(read_robot(folder / "defender.toml"), core::defender);
  EXPECT_EQ(read_robot(folder / "goalkeeper.toml"), core::goalkeeper);
}

TEST(RobotFile, TheDrivesOfOthersAreRead) {
  const std::filesystem::path folder = STRIKER_ROBOTS;
  for (const char* const name : {"forward-odrive.toml", "forward-cia402.toml"}) {
    EXPECT_EQ(read_robot(folder / name), core::forward) << name;
  }
  EXPECT_EQ(read_robot_and_drives(folder / "forward.toml").wiring, can::DriveWiring{});
  EXPECT_EQ(read_robot_and_drives(folder / "forward-odrive.toml").wiring,
            (can::DriveWiring{.kind = can::DriveKind::odrive,
                              .identifier_base = 768,
                              .left_node = 0,
                              .right_node = 1,
                              .right_reversed = 1}));
  EXPECT_EQ(read_robot_and_drives(folder / "forward-cia402.toml").wiring,
            (can::DriveWiring{.kind = can::DriveKind::cia402,
                              .identifier_base = 768,
                              .left_node = 1,
                              .right_node = 2,
                              .right_reversed = 1,
                              .gear_percent = 500,
                              .rated_torque_mNm = 80}));
}

const std::string sound =
    "body_mass_g = 2_200\nwheel_mass_g = 120\nwheel_radius_um = 50_000\naxle_length_um = 200_000\n"
    "torque_limit_mNm = 600\ntop_rim_speed_mm_s = 1_500\ncamera_latency_ms = 35\ncommand_delay_ms = 20\n";

std::string problem_of(const std::string& text) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "striker_robot.toml";
  std::ofstream(file) << text;
  try {
    (void)read_robot(file);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(RobotFile, ARobotOfOnesOwnIsRead) {
  EXPECT_EQ(problem_of(sound), "");
  EXPECT_EQ(problem_of(sound + "camera_rate_Hz = 10\n"), "");
  EXPECT_EQ(problem_of(sound + "camera_rate_Hz = 100\n"), "");
}

TEST(RobotFile, WhatIsWrongIsNamedWithItsPlace) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "body_mass_g is missing: give a whole number from 200 to 100000"},
      {sound + "colour = 3\n", "line 9: 'colour' is no key of a robot; there are body_mass_g, "},
      {"body_mass_g = 5\n" + sound.substr(sound.find('\n') + 1),
       "line 1: body_mass_g = 5 must be a whole number from 200 to 100000"},
      {"body_mass_g = 2.2\n" + sound.substr(sound.find('\n') + 1),
       "line 1: body_mass_g must be a whole number"},
      {sound + "camera_latency_ms = 1\n", "line 9: "},
      {"body_mass_g = 2_200\nwheel_mass_g = 29" + sound.substr(sound.find("120") + 3),
       "wheel_mass_g = 29 is too little"},
      {sound + "camera_rate_Hz = 9\n", "line 9: camera_rate_Hz = 9 must be a whole number from 10 to 100"},
      {sound + "camera_rate_Hz = 101\n", "line 9: camera_rate_Hz = 101 must be a whole number"},
      {sound + "camera_rate_Hz = 59.94\n", "line 9: camera_rate_Hz must be a whole number"},
      {sound + "drives = \"moteus\"\n",
       "line 9: drives = \"moteus\" must be one of \"striker\", \"odrive\", \"cia402\""},
      {sound + "drives = 1\n", "line 9: 'drives = 1' is no name of drives"},
      {sound + "drives = 'odrive'\n", "line 9: 'drives = 'odrive'' is no name of drives"},
      {sound + "drive_left_node = 128\n",
       "line 9: drive_left_node = 128 must be a whole number from 0 to 127"},
      {sound + "drive_left_node = 2\n", "drive_left_node and drive_right_node are both 2"},
      {sound + "identifier_base = 4\n", "identifier_base = 4 must be a multiple of 8"},
      {sound + "drives = \"cia402\"\ndrive_rated_torque_mNm = 100_000\ndrive_gear_percent = 500\n",
       "torque_limit_mNm = 600 is 1 per mille of the motor's rated torque at the wheel, which must be 20 to 32767"},
      {sound + "drives = \"cia402\"\ndrive_rated_torque_mNm = 10\ndrive_gear_percent = 10\n",
       "torque_limit_mNm = 600 is 600000 per mille"},
      {sound + "drives = \"cia402\"\ndrive_gear_percent = 10_000\ndrive_rated_torque_mNm = 10\n"
               "drive_counts_per_turn = 10_000_000\n",
       "drive_counts_per_turn = 10000000 makes "},
      {"= 3", "line 1: "}};
  for (const auto& [text, expected] : cases) {
    const std::string problem = problem_of(text);
    EXPECT_NE(problem.find("striker_robot.toml: " + expected), std::string::npos) << problem;
  }
}

}  // namespace
}  // namespace striker::sil
