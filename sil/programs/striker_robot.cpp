// SPDX-License-Identifier: Apache-2.0
// striker-robot: what follows from a robot's description.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <string>

#include "firmware/host/command_line.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "firmware/policy/built_in.hpp"
#include "sil/robot/description/robot_file.hpp"
#include "sil/robot/description/robot_report.hpp"

namespace {

using namespace striker;

constexpr int exit_does_not_fit = 1;

// The policy's fastest wheel.
int fastest_mm_s() {
  int fastest = 0;
  for (const policy::WheelSetPoint& action : loop::BuiltInPilot::set_points) {
    fastest = std::max({fastest, std::abs(action.left_mm_s), std::abs(action.right_mm_s)});
  }
  return fastest;
}

int check(const std::string& file, const std::string& json) {
  const core::RobotDescription robot = sil::read_robot(file);
  const sil::RobotFigures figures = sil::figures_of(robot);
  const bool fits = loop::BuiltInPilot::suits(core::profile_of(robot));
  fmt::print("{}", sil::robot_report(figures));
  fmt::print(
      "{:<14} {} {:08x} {}\n", "policy", policy::built_in_name, policy::built_in.identity,
      fits ? "fits"
           : fmt::format("does not fit: it drives the wheels at up to {} mm/s. Train one for this robot, and "
                         "build with -DSTRIKER_POLICY=HEADER",
                         fastest_mm_s()));
  if (!json.empty()) {
    sil::write_robot_json(figures, file, fits, json);
  }
  return fits ? 0 : exit_does_not_fit;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "What follows from a robot's description (TOML; its keys are in sil/robot/description/robot_file.hpp).",
      "striker-robot");
  app.require_subcommand(1);
  std::string file;
  std::string json;
  CLI::App& subcommand = *app.add_subcommand(
      "check",
      "Acceleration and stopping, the wheel loops' gains and margins, slip and overspeed limits, and whether this "
      "build's policy fits. Exit status: 0 it fits, 1 it does not, 2 wrong use, or no such robot.");
  host::reads_file(subcommand.add_option("file", file, "the description")->required());
  host::writes_file(subcommand.add_option("--json", json, "write the figures"));
  return host::run(
      app, argc, argv, [&] { return check(file, json); },
      fmt::format("policy {} {:08x}", policy::built_in_name, policy::built_in.identity));
}
