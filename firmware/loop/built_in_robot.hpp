// SPDX-License-Identifier: Apache-2.0
// The robot that this build's controller is for, and that the simulator plays unless told otherwise; and what it speaks to
// its wheels with (firmware/can/drives/drive_wiring.hpp).
//
// The build chooses it: cmake -DSTRIKER_ROBOT=FILE.toml, one of firmware/robots or of your own. STRIKER_ROBOT_HEADER is
// the path of the header that firmware/robots/robot_header.cmake makes of the file, as a string; without it, it is AI
// Soccer's forward. `striker-robot check FILE` says what follows from a file, and what is wrong with one.
#pragma once

#include "firmware/can/drives/drive_wiring.hpp"
#include "firmware/can/drives/drives_of.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/robot_ranges.hpp"

#ifdef STRIKER_ROBOT_HEADER
#include STRIKER_ROBOT_HEADER
#else
namespace striker::loop {

inline constexpr core::RobotDescription built_in_description = core::forward;
inline constexpr can::DriveWiring built_in_wiring = {};

}  // namespace striker::loop
#endif

namespace striker::loop {

static_assert(core::in_range(built_in_description),
              "STRIKER ROBOT: a number is missing or out of range: striker-robot check FILE says which");

static_assert(
    core::wheels_are_heavy_enough(built_in_description),
    "STRIKER ROBOT: its wheels are too light for their torque: striker-robot check FILE says how much");

inline constexpr core::RobotProfile built_in_robot = core::profile_of(built_in_description);

static_assert(core::loops_fit(built_in_robot),
              "STRIKER ROBOT: its wheel loops would not fit 32 bits: look at mass, radius and torque again");

static_assert(can::in_range(built_in_wiring),
              "STRIKER DRIVES: a number of the drives is out of range, or both wheels have one node: "
              "striker-robot check FILE says which");
static_assert(can::torque_fits(built_in_wiring, built_in_description.torque_limit_mNm) &&
                  can::speed_fits(built_in_wiring, core::greatest_measured_mm_s),
              "STRIKER DRIVES: torque or speed does not fit the drives' numbers: striker-robot check FILE "
              "says which");
static_assert(built_in_wiring.identifier_base == can::identifier_base,
              "STRIKER DRIVES: identifier_base is not the one that this file is compiled with "
              "(STRIKER_CAN_BASE)");

using BuiltInDrives = can::DrivesOf<built_in_wiring>;

}  // namespace striker::loop
