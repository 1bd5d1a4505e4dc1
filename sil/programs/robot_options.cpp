// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/robot_options.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "firmware/host/command_line.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "sil/robot/description/robot_file.hpp"
#include "sil/robot/variation.hpp"

namespace striker::sil {

namespace {

// Before any file is opened.
std::string vary_problem(const std::string& text) {
  try {
    static_cast<void>(variation_of(text));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return text.empty() ? "give NAME=VALUE, as mass=0.9" : "";
}

// Nodes and gears are part of the controller's type.
bool is_wired_as_built(const can::DriveWiring& wiring) {
  constexpr const can::DriveWiring& built = loop::built_in_wiring;
  const bool is_own = wiring.kind == can::DriveKind::striker && built.kind == wiring.kind;
  return is_own ? wiring.identifier_base == built.identifier_base : wiring == built;
}

}  // namespace

void define_robot(CLI::App& command, std::string& file) {
  host::reads_file(command.add_option("--robot", file,
                                      "the description that controller and world (inproc) are of; default: a "
                                      "forward, firmware/robots/forward.toml"));
}

void define_variation(CLI::App& command, std::string& vary) {
  command
      .add_option(
          "--vary", vary,
          "another robot than the controller was told: mass=0.9,friction=0.5,vision_latency_ms=35 (shares: mass, "
          "torque, friction, ball_damping; vision_noise_mm, vision_latency_ms, command_delay_ms; camera_rate_Hz)")
      ->check(vary_problem);
}

void require_robot_in_process(CLI::App& command, const std::string& bus) {
  host::require_meaning(command, bus == "inproc", {"--robot"},
                        "--bus inproc: a controller on a bus is told of its robot when it is built");
}

core::RobotDescription described_robot(const std::string& file, Suits suits) {
  core::RobotDescription robot = loop::built_in_description;
  if (!file.empty()) {
    const auto [described, wiring] = read_robot_and_drives(file);
    if (!is_wired_as_built(wiring)) {
      throw std::runtime_error(fmt::format(
          "{}: its drives, their wiring or identifier_base are not those that this program is built for: "
          "configure with -DSTRIKER_ROBOT={}",
          file, file));
    }
    robot = described;
  }
  const bool is_built_in = suits == nullptr;
  if (!(is_built_in ? loop::BuiltInPilot::suits : suits)(core::profile_of(robot))) {
    throw std::runtime_error(
        fmt::format("{}: the policy's actions go beyond top_rim_speed_mm_s = {}: train one for this robot{}",
                    file.empty() ? "the built-in robot" : file, robot.top_rim_speed_mm_s,
                    is_built_in ? ", and build with -DSTRIKER_POLICY=HEADER" : ""));
  }
  return robot;
}

}  // namespace striker::sil
