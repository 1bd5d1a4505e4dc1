// SPDX-License-Identifier: Apache-2.0
// striker-robot: what follows from a robot's description.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <string>

#include "firmware/host/command_line.hpp"
#include "firmware/host/files.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "firmware/policy/built_in.hpp"
#include "sil/programs/robot_options.hpp"
#include "sil/robot/description/robot_file.hpp"
#include "sil/robot/description/robot_report.hpp"
#include "sil/robot/step_response.hpp"

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
  const sil::DescribedFigures figures = sil::figures_of(robot);
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

struct StepCommand {
  std::string file;
  std::string vary;
  std::string csv;
  sil::StepOptions step;
};

int show_step(const StepCommand& command) {
  const auto rows =
      sil::step_response(sil::read_robot(command.file), sil::variation_of(command.vary), command.step);
  if (!command.csv.empty()) {
    host::write_file(command.csv, sil::step_csv(rows));
  }
  fmt::print("{}", sil::step_table(sil::figures_of(rows, command.step)));
  return 0;
}

void define_step(CLI::App& step, StepCommand& command) {
  host::reads_file(step.add_option("file", command.file, "the description")->required());
  sil::define_variation(step, command.vary);
  step.add_option("--set-point", command.step.set_point_m_s, "of both rims, in m/s; left out: the top speed")
      ->check(CLI::Range(0.01, 4.0));
  step.add_option("--step-ms", command.step.step_ms, "how long each step lasts")
      ->check(CLI::Range(10U, 10'000U))
      ->capture_default_str();
  step.add_flag("--turn", command.step.turns, "on the spot: the left wheel is told the opposite");
  host::writes_file(step.add_option("--csv", command.csv, "write every ms of it"));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "What follows from a robot's description (TOML; its keys are in sil/robot/description/robot_file.hpp).",
      "striker-robot");
  app.require_subcommand(1);
  std::string file;
  std::string json;
  CLI::App& checked = *app.add_subcommand(
      "check",
      "Acceleration and stopping, the wheel loops' gains and margins, slip and overspeed limits, and whether this "
      "build's policy fits. Exit status: 0 it fits, 1 it does not, 2 wrong use, or no such robot.");
  host::reads_file(checked.add_option("file", file, "the description")->required());
  host::writes_file(checked.add_option("--json", json, "write the figures"));
  StepCommand command;
  CLI::App& stepped = *app.add_subcommand(
      "step",
      "Steps of the set-point, up, to its opposite and to 0: the firmware's wheel loops on torque drives in the full "
      "world. striker-plot-steps draws them.");
  define_step(stepped, command);
  return host::run(
      app, argc, argv, [&] { return checked.parsed() ? check(file, json) : show_step(command); },
      fmt::format("policy {} {:08x}", policy::built_in_name, policy::built_in.identity));
}
