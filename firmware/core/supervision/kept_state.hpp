// SPDX-License-Identifier: Apache-2.0
// What a controller keeps from one step to the next, in two parts that are sealed apart (seal.hpp): what every tick
// changes, and what a picture or a decision does, as most ticks do neither.
#pragma once

#include <cstdint>

#include "firmware/core/actions.hpp"
#include "firmware/core/decision_clock.hpp"
#include "firmware/core/estimation/estimator.hpp"
#include "firmware/core/estimation/plausibility.hpp"
#include "firmware/core/orders/standing_order.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/supervision/consent.hpp"
#include "firmware/core/supervision/supervisor.hpp"
#include "firmware/core/supervision/vigilance.hpp"
#include "firmware/core/wheel_loop.hpp"

namespace striker::core {

// Without padding.
template <class Pilot>
struct KeptEachTick {
  constexpr KeptEachTick(const RobotProfile& profile, std::uint32_t seed) : robot(profile), consent(seed) {}

  RobotProfile robot;
  std::uint32_t tick = 0;
  std::uint32_t boot_tick = 0;
  std::uint32_t fault_tick = 0;
  std::uint32_t has_velocity = 0;  // of the estimator
  std::uint32_t new_picture = 0;   // in this tick
  SelfTest self_test = SelfTest::running;
  Supervisor supervisor;
  Consent consent;
  Vigilance vigilance;
  WheelPlausibility plausibility;
  Odometry odometry;
  DecisionClock clock;
  WheelLoops loops;
  WheelSpeeds measured;
  WheelSpeeds set_point;  // the pilot's, or an order's
  std::uint32_t kick_over = 0;
  StandingOrder orders;
  WheelTorques torque;  // of the last command
  typename Pilot::WeightsCheck weights;
};

template <class Pilot>
struct KeptMemory {
  Estimator estimator;
  Pilot pilot;
};

}  // namespace striker::core
