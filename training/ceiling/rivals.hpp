// SPDX-License-Identifier: Apache-2.0
// Scripted rivals of the network in the official kick task: what a simple rule gets, what a good engineer's
// rule gets, and what a planner gets that knows the simulation. They see what the network sees (the paper's
// RCS state with true velocities), and how many decisions are left.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>

#include "training/line/line_play.hpp"
#include "training/task/kick_environment.hpp"

namespace striker::training {

// Starts when the way to where the ball will cross the line takes as long as the ball does; before that it
// backs up if the run-up is short and there is time. The parameters are the best of 1,000 draws on 2,000
// training episodes of seed 1 (tests/training/ceiling/rivals_test.cpp repeats the search): for a forward, whatever robot
// it drives.
struct InterceptorParameters {
  double stop_short_m = 0.1364;       // of the crossing, the robot's centre
  double lead_s = 0.0481;             // starts so much too early
  double run_up_m = 0.9551;           // backs up if the way is shorter
  double time_to_back_up_s = 0.1555;  // and at least so much time is left over
};

[[nodiscard]] int intercept(const InterceptorParameters& parameters, const KickEnvironment& env);

// Simulates every "reverse for up to 12 decisions, wait, then forward" from here on, and begins the best one.
// It plans anew at each decision.
[[nodiscard]] int plan_ahead(const KickEnvironment& env);

enum class Rival { forward, stop, random, interceptor, planner };
inline constexpr std::array all_rivals = {Rival::forward, Rival::stop, Rival::random, Rival::interceptor,
                                          Rival::planner};

[[nodiscard]] std::string_view name_of(Rival rival);

// What a rule does in a situation: the number of an action.
using ActionRule = std::function<int(const KickEnvironment&)>;

// For one episode: the random one draws from (seed, episode).
[[nodiscard]] ActionRule rule_of(Rival rival, std::uint64_t seed, std::uint64_t episode);

}  // namespace striker::training
