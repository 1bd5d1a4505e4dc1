// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/step_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "firmware/core/wheel_loop.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

namespace {

constexpr std::size_t the_robot = 0;
constexpr double least_slip_mm_s = 50.0;  // more than three counts of the encoder in a ms

core::WheelSpeeds counted(const RimSpeeds& measured) {
  return {static_cast<std::int32_t>(std::lround(1e3 * measured.left_m_s)),
          static_cast<std::int32_t>(std::lround(1e3 * measured.right_m_s))};
}

WheelOrders orders_of(const core::WheelTorques& torque) {
  return {WheelOrder{.torque_Nm = torque.left_mNm / 1e3}, WheelOrder{.torque_Nm = torque.right_mNm / 1e3}};
}

// How fast the floor passes by under the right wheel, from two poses a tick apart.
double moved_mm_s(const Pose& before, const Pose& after, double axle_length_m) {
  const double forward_m = (after.x_m - before.x_m) * std::cos(before.heading_rad) +
                           (after.y_m - before.y_m) * std::sin(before.heading_rad);
  const double turned_rad = std::remainder(after.heading_rad - before.heading_rad, 2.0 * std::numbers::pi);
  return 1e3 * (forward_m + 0.5 * axle_length_m * turned_rad) / tick_s;
}

}  // namespace

std::vector<StepRow> step_response(const core::RobotDescription& robot, const Variation& variation,
                                   const StepOptions& options) {
  const auto set_point_mm_s = options.set_point_m_s == 0.0
                                  ? robot.top_rim_speed_mm_s
                                  : static_cast<std::int32_t>(std::lround(1e3 * options.set_point_m_s));
  if (std::abs(set_point_mm_s) > robot.top_rim_speed_mm_s) {
    throw std::runtime_error(fmt::format("a set-point of {} mm/s is beyond top_rim_speed_mm_s = {}",
                                         set_point_mm_s, robot.top_rim_speed_mm_s));
  }
  Variation of_camera_and_ball = variation;
  of_camera_and_ball.mass = of_camera_and_ball.torque = of_camera_and_ball.friction = 1.0;
  of_camera_and_ball.command_delay_ms.reset();
  if (of_camera_and_ball != Variation{}) {
    throw std::runtime_error(
        "a step has no camera and no ball: vary mass, torque, friction and command_delay_ms");
  }
  const core::RobotProfile profile = core::profile_of(robot);
  const auto plants = make_plants(PlantKind::drive, spec_of(robot), completed(variation, robot));
  Plant& plant = *plants.back();
  World world(WorldConfig{.robots = {varied(spec_of(robot), variation)}, .walls = false, .step_s = tick_s});
  world.place_robot(the_robot, {});
  world.place_ball({.position_m = {0.0, 3.0}, .velocity_m_s = {}});
  plant.reset();
  core::WheelLoops loops;
  core::PendingTorques pending;
  std::vector<StepRow> rows;
  rows.reserve(4UL * options.step_ms);
  for (std::uint32_t tick = 0; tick < 4 * options.step_ms; ++tick) {
    const std::uint32_t step = tick / options.step_ms;
    const std::int32_t right_mm_s = step == 1 ? set_point_mm_s : step == 2 ? -set_point_mm_s : 0;
    const core::WheelSpeeds measured = counted(plant.measured());
    const core::WheelSpeeds rolling = loops.see(profile, measured);
    const core::WheelTorques torque =
        loops.step(profile, {options.turns ? -right_mm_s : right_mm_s, right_mm_s}, measured, pending);
    const Pose before = world.robot_pose(the_robot);
    plant.actuate(world, orders_of(torque), false);
    world.step();
    plant.sense(world);
    rows.push_back(
        {.time_ms = tick,
         .set_point_mm_s = right_mm_s,
         .measured_mm_s = measured.right_mm_s,
         .rolling_mm_s = rolling.right_mm_s,
         .torque_mNm = torque.right_mNm,
         .moved_mm_s = moved_mm_s(before, world.robot_pose(the_robot), robot.axle_length_um / 1e6)});
  }
  return rows;
}

StepFigures figures_of(const std::vector<StepRow>& rows, const StepOptions& options) {
  StepFigures figures;
  const auto first = rows.begin() + options.step_ms;
  const double set_point_mm_s = first->set_point_mm_s;
  double greatest = 0.0;
  for (auto row = first; row != first + options.step_ms; ++row) {
    const double share = row->moved_mm_s / set_point_mm_s;
    const auto passed_ms = static_cast<int>(row->time_ms - options.step_ms);
    figures.tenth_ms = figures.tenth_ms < 0 && share >= 0.1 ? passed_ms : figures.tenth_ms;
    figures.nine_tenths_ms = figures.nine_tenths_ms < 0 && share >= 0.9 ? passed_ms : figures.nine_tenths_ms;
    greatest = std::max(greatest, share);
  }
  figures.overshoot_percent = std::max(0.0, 100.0 * (greatest - 1.0));
  const double slips_mm_s = std::max(0.1 * std::abs(set_point_mm_s), least_slip_mm_s);
  for (auto row = rows.begin(); row + 1 < rows.end(); ++row) {
    const double slip_mm_s = std::abs((row + 1)->measured_mm_s - row->moved_mm_s);
    figures.greatest_slip_mm_s = std::max(figures.greatest_slip_mm_s, slip_mm_s);
    figures.slipping_ms += slip_mm_s > slips_mm_s ? 1 : 0;
  }
  return figures;
}

std::string step_table(const StepFigures& figures) {
  const std::string rise =
      figures.nine_tenths_ms < 0
          ? "the first step is not reached"
          : fmt::format("{} ms from a tenth to nine tenths of the first step, {} ms in all",
                        figures.nine_tenths_ms - figures.tenth_ms, figures.nine_tenths_ms);
  return fmt::format(
      "{:<10} {}\n{:<10} {:.1f} % of the step\n{:<10} {:.0f} mm/s between rim and floor at most; above a tenth of the step for "
      "{} ms in all\n",
      "rise", rise, "overshoot", figures.overshoot_percent, "slip", figures.greatest_slip_mm_s,
      figures.slipping_ms);
}

std::string step_csv(const std::vector<StepRow>& rows) {
  std::string csv = "time_ms,set_point_mm_s,measured_mm_s,rolling_mm_s,torque_mNm,moved_mm_s\n";
  for (const StepRow& row : rows) {
    csv += fmt::format("{},{},{},{},{},{:.3f}\n", row.time_ms, row.set_point_mm_s, row.measured_mm_s,
                       row.rolling_mm_s, row.torque_mNm, row.moved_mm_s);
  }
  return csv;
}

}  // namespace striker::sil
