// SPDX-License-Identifier: Apache-2.0
// Whether a robot would leave the field: a border that its description may set (field_half_length_mm and
// field_half_width_mm, of a field around the origin of the camera's coordinates). A kick ends before it.
//
// A decision holds for `decision_period_ticks`, then the robot brakes by what its torque can and its tyres hold, as soon as
// wheel loops and delays let it: by then its centre must be within the border, 10 mm spared, along its heading. A robot
// that turns meanwhile, or slides, is not foreseen. One that stands outside may drive back in. Once a decision.
#pragma once

#include "firmware/core/estimation/estimator.hpp"
#include "firmware/core/percepts.hpp"
#include "firmware/core/robot_profile.hpp"

namespace striker::core {

// `now` as the decision sees it, and the set-points that it makes.
[[nodiscard]] bool leaves_field(const RobotProfile& robot, const Estimate& now, const WheelSpeeds& set_point);

}  // namespace striker::core
