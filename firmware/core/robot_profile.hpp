// SPDX-License-Identifier: Apache-2.0
// A robot as data: what the controller has to know of it, and where that comes from.
//
// `RobotDescription` holds what can be weighed and read off a motor's data sheet. `profile_of` derives what
// the wheel loops and the checks need, in integers, when the program is compiled. Other people's robots are
// other descriptions; nothing else in the core knows a robot's number.
//
//   constexpr RobotDescription mine = {.body_mass_g = 2200, .wheel_mass_g = 120, .wheel_radius_um = 50'000, .axle_length_um = 160'000,
//                                      .torque_limit_mNm = 600, .top_rim_speed_mm_s = 1500};
//   Controller<Pilot<policy::kick>> controller(profile_of(mine));
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "firmware/core/tick.hpp"

namespace striker::core {

struct RobotDescription {
  std::int32_t body_mass_g;
  std::int32_t wheel_mass_g;  // each: a solid cylinder
  std::int32_t wheel_radius_um;
  std::int32_t axle_length_um;               // between the wheels' centres
  std::int32_t torque_limit_mNm;             // of each wheel
  std::int32_t top_rim_speed_mm_s;           // of each wheel
  std::int32_t camera_latency_ms = 0;        // from a picture to its frames: 0 to 50
  std::int32_t camera_rate_Hz = 20;          // pictures a second: 10 to 100
  std::int32_t tyre_friction_percent = 300;  // Coulomb, between tyre and floor: 300 is a coefficient of 3.0
  std::int32_t command_delay_ms = 0;         // from a command's frame to the torque: 0 to 50
  // Where a kick ends, from the origin of the camera's coordinates; 0: no border (estimation/field_border.hpp).
  std::int32_t field_half_length_mm = 0;  // along x
  std::int32_t field_half_width_mm = 0;   // along y

  bool operator==(const RobotDescription&) const = default;
};

// The AI Soccer roles (AI World Cup test_world, branch master 37312a93).
inline constexpr RobotDescription goalkeeper = {.body_mass_g = 2500,
                                                .wheel_mass_g = 150,
                                                .wheel_radius_um = 40'000,
                                                .axle_length_um = 140'000,
                                                .torque_limit_mNm = 800,
                                                .top_rim_speed_mm_s = 1800};
inline constexpr RobotDescription defender = {.body_mass_g = 2000,
                                              .wheel_mass_g = 100,
                                              .wheel_radius_um = 40'000,
                                              .axle_length_um = 140'000,
                                              .torque_limit_mNm = 1200,
                                              .top_rim_speed_mm_s = 2100};
inline constexpr RobotDescription forward = {.body_mass_g = 1500,
                                             .wheel_mass_g = 100,
                                             .wheel_radius_um = 40'000,
                                             .axle_length_um = 140'000,
                                             .torque_limit_mNm = 400,
                                             .top_rim_speed_mm_s = 2550};

inline constexpr std::int32_t greatest_delay_ticks = 50;
inline constexpr std::int32_t torque_steps = 127;  // of the limit, in which pending torque is kept

// Of the camera. Slower, two pictures would be further apart than what is fresh (percepts.hpp). Faster, the same number
// would come again within that time.
inline constexpr std::int32_t least_picture_period_us = 10'000;
inline constexpr std::int32_t greatest_picture_period_us = 100'000;

struct RobotProfile {
  std::int32_t torque_limit_mNm = 0;
  std::int32_t top_rim_speed_mm_s = 0;  // no set-point beyond it
  std::int32_t overspeed_mm_s = 0;      // a wheel this fast must not be driven further
  std::int32_t kp_q8 = 0;               // of the wheel loops: mNm for a mm/s
  std::int32_t ki_tick_q16 = 0;         // mNm for a mm/s and a tick
  std::int32_t slip_gain_q12 = 0;       // what a mNm on both wheels adds in a tick, in mm/s: gripping
  std::int32_t camera_latency_ticks = 0;
  std::int32_t picture_period_us = decision_period_us;
  std::int32_t command_delay_ticks = 0;
  std::int32_t pending_gain_q12 = 0;  // what a step of torque on both wheels adds in a tick, in mm/s
  std::int32_t turn_q12 = 0;          // binary angle for a um that the right rim is ahead of the left
  // For estimation/field_border.hpp.
  std::int32_t field_half_length_um = 0;  // less a margin; 0: no border
  std::int32_t field_half_width_um = 0;
  std::int32_t decision_gain_mm_s = 0;  // the most that a decision changes the speed by
  std::int32_t braking_q4 = 1;          // what a tick of braking surely takes of it, in 16ths of mm/s
  std::int32_t braking_late_ticks = 0;  // that it begins later than it is wanted, as loops and delays have it

  bool operator==(const RobotProfile&) const = default;
};

namespace detail {

// The loops cross over near 100 rad/s: a decade below the 3 ms that measurement, tick and current loop delay. A delay
// of the commands is predicted (pending_torque.hpp); half of it counts as unknown, and takes 0.6 rad of the phase with
// those 3 ms at most. The integral's corner is a decade below.
constexpr std::int64_t crossover_rad_s(std::int64_t command_delay_ms) {
  constexpr std::int64_t own_delay_ms = 3;
  return std::min<std::int64_t>(100, 600 / (own_delay_ms + std::max<std::int64_t>(command_delay_ms, 0) / 2));
}

inline constexpr std::int64_t overspeed_percent = 115;

// While it brakes a robot's skids carry a part of its weight, and its tyres hold less than their friction of all of it: in
// the full world 39 % at a coefficient of 3.0, 60 % at 1.0 (sil/README.md).
inline constexpr std::int64_t held_when_braking_percent = 35;
inline constexpr std::int64_t gravity_mm_s2 = 9'810;
inline constexpr std::int32_t border_margin_um = 10'000;

constexpr std::int32_t border_um(std::int32_t half_mm) {
  return half_mm == 0 ? 0 : std::max<std::int32_t>(1'000 * half_mm - border_margin_um, 1);
}

// numerator / denominator to the nearest.
constexpr std::int32_t rounded_ratio(std::int64_t numerator, std::int64_t denominator) {
  return static_cast<std::int32_t>((2 * numerator + denominator) / (2 * denominator));
}

}  // namespace detail

// Both wheels at torque T accelerate the robot by 2 T / (r m), where m is its whole mass with the wheels'
// spin (half a cylinder's mass at the rim): a forward, 1.8 kg, by 27.8 mm/s^2 for each mNm. So kp is
// crossover * r m / 2, in N m / (m/s), which is the same number in mNm / (mm/s).
[[nodiscard]] constexpr RobotProfile profile_of(const RobotDescription& robot) {
  using namespace detail;
  const std::int64_t moved_mass_g = robot.body_mass_g + 3 * robot.wheel_mass_g;
  const std::int64_t radius_mass = std::int64_t{robot.wheel_radius_um} * moved_mass_g;
  const std::int64_t crossover = crossover_rad_s(robot.command_delay_ms);
  const std::int64_t kp_e9 = crossover * robot.wheel_radius_um * moved_mass_g / 2;
  constexpr std::int64_t e9 = 1'000'000'000;
  constexpr std::int64_t ticks_a_second = 1'000;
  const std::int64_t acceleration_mm_s2 = 2'000'000'000 * std::int64_t{robot.torque_limit_mNm} / radius_mass;
  const std::int64_t held_mm_s2 =
      held_when_braking_percent * gravity_mm_s2 * robot.tyre_friction_percent / 10'000;
  constexpr std::int64_t circle_um_e3 =
      10'430'378;  // 65,536 / (2 pi): counts for an arc of one axle's length
  return {
      .torque_limit_mNm = robot.torque_limit_mNm,
      .top_rim_speed_mm_s = robot.top_rim_speed_mm_s,
      .overspeed_mm_s = rounded_ratio(overspeed_percent * robot.top_rim_speed_mm_s, 100),
      .kp_q8 = rounded_ratio(256 * kp_e9, e9),
      .ki_tick_q16 = rounded_ratio(65'536 * (crossover * kp_e9 / 10), ticks_a_second * e9),
      .slip_gain_q12 = rounded_ratio(8'192'000'000, radius_mass),
      .camera_latency_ticks = robot.camera_latency_ms,
      .picture_period_us = rounded_ratio(1'000'000, robot.camera_rate_Hz),
      .command_delay_ticks = robot.command_delay_ms,
      .pending_gain_q12 = rounded_ratio(8'192'000'000 * robot.torque_limit_mNm, torque_steps * radius_mass),
      .turn_q12 = rounded_ratio(4'096 * circle_um_e3, 1'000 * std::int64_t{robot.axle_length_um}),
      .field_half_length_um = border_um(robot.field_half_length_mm),
      .field_half_width_um = border_um(robot.field_half_width_mm),
      .decision_gain_mm_s =
          static_cast<std::int32_t>(decision_period_ms * acceleration_mm_s2 / ticks_a_second) + 1,
      .braking_q4 = static_cast<std::int32_t>(
          std::max<std::int64_t>(16 * std::min(acceleration_mm_s2, held_mm_s2) / ticks_a_second, 1)),
      .braking_late_ticks = static_cast<std::int32_t>(ticks_a_second / crossover)};
}

// The ball's speed and the robot's are measured over about the time between two decisions, as in training: from a
// picture to the first that comes as near to that as any. The other pictures tell places alone.
[[nodiscard]] constexpr bool span_a_decision(const RobotProfile& robot, std::int32_t pictures) {
  return pictures * robot.picture_period_us + robot.picture_period_us / 2 > decision_period_us;
}

// The pictures' times between those two.
[[nodiscard]] constexpr std::uint32_t pictures_a_motion(const RobotProfile& robot) {
  std::int32_t pictures = 1;
  while (!span_a_decision(robot, pictures)) {
    ++pictures;
  }
  return static_cast<std::uint32_t>(pictures);
}

// Every picture is one decision's.
[[nodiscard]] constexpr bool decides_on_each_picture(const RobotProfile& robot) {
  return robot.picture_period_us == decision_period_us;
}

inline constexpr std::int32_t greatest_measured_mm_s = 8'000;

// No product and no sum of the wheel loops leaves 32 bits, for measured speeds within that. Where a loop
// integrates it is not saturated: its error is what the torque limit allows, or less.
[[nodiscard]] constexpr bool loops_fit(const RobotProfile& robot) {
  constexpr std::int32_t greatest_torque_mNm = 32'000;
  if (robot.torque_limit_mNm <= 0 || robot.torque_limit_mNm > greatest_torque_mNm || robot.kp_q8 <= 0 ||
      robot.ki_tick_q16 < 0 || robot.top_rim_speed_mm_s <= 0 ||
      robot.top_rim_speed_mm_s > greatest_measured_mm_s) {
    return false;
  }
  constexpr std::int64_t greatest = std::numeric_limits<std::int32_t>::max();
  if (robot.camera_latency_ticks < 0 || robot.camera_latency_ticks > greatest_delay_ticks ||
      robot.picture_period_us < least_picture_period_us ||
      robot.picture_period_us > greatest_picture_period_us || robot.command_delay_ticks < 0 ||
      robot.command_delay_ticks > greatest_delay_ticks || robot.pending_gain_q12 <= 0 ||
      std::int64_t{greatest_delay_ticks} * torque_steps * robot.pending_gain_q12 > greatest ||
      robot.slip_gain_q12 <= 0 ||
      std::int64_t{robot.slip_gain_q12} * robot.torque_limit_mNm > greatest / 16) {
    return false;
  }
  const std::int32_t error_mm_s = greatest_measured_mm_s + robot.top_rim_speed_mm_s;
  const std::int32_t integrated_mm_s =
      robot.command_delay_ticks != 0 ? error_mm_s : (2 * robot.torque_limit_mNm + 2) * 256 / robot.kp_q8 + 1;
  return std::int64_t{error_mm_s} * robot.kp_q8 <= greatest &&
         std::int64_t{robot.torque_limit_mNm} * 65536 +
                 std::int64_t{integrated_mm_s < error_mm_s ? integrated_mm_s : error_mm_s} *
                     robot.ki_tick_q16 <=
             greatest;
}

static_assert(loops_fit(profile_of(forward)) && loops_fit(profile_of(defender)) &&
              loops_fit(profile_of(goalkeeper)));

static_assert(profile_of(forward) == RobotProfile{.torque_limit_mNm = 400,
                                                  .top_rim_speed_mm_s = 2550,
                                                  .overspeed_mm_s = 2933,
                                                  .kp_q8 = 922,          // 3.6 mNm/(mm/s)
                                                  .ki_tick_q16 = 2359,   // 36 mNm/(mm/s)/s at 1 kHz
                                                  .slip_gain_q12 = 114,  // 0.0278 mm/s
                                                  .camera_latency_ticks = 0,
                                                  .picture_period_us = 50'000,
                                                  .command_delay_ticks = 0,
                                                  .pending_gain_q12 = 358,  // 0.0875 mm/s
                                                  .turn_q12 = 305,
                                                  .field_half_length_um = 0,
                                                  .field_half_width_um = 0,
                                                  .decision_gain_mm_s = 556,
                                                  .braking_q4 = 164,  // 10.3 mm/s
                                                  .braking_late_ticks = 10});

}  // namespace striker::core
