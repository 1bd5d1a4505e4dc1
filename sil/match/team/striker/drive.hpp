// SPDX-License-Identifier: Apache-2.0
// How the team `striker` drives: a go-to that stops where it is told to, or passes there at a given speed, forwards or
// backwards, whichever way round is nearer.
#pragma once

#include "sil/match/team/order.hpp"

namespace striker::sil {

[[nodiscard]] SpeedOrder drive_to(const Pose& robot, Vec2 target_m, double top_m_s, double passing_m_s = 0.0);

// As fast as it can, steering at this point.
[[nodiscard]] SpeedOrder drive_through(const Pose& robot, Vec2 point_m, double top_m_s);

// Turns on the spot until its front is in this direction.
[[nodiscard]] SpeedOrder face(const Pose& robot, double heading_rad, double top_m_s);

}  // namespace striker::sil
