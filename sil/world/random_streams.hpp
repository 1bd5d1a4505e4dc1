// SPDX-License-Identifier: Apache-2.0
// Which number each use of randomness has as the tag of its sil::Random: a stream of its own, so that a new
// kind of draw disturbs no other. This is the only list of them. Below 100 the task draws an episode, from
// 100 on a trainer learns from it, from 200 on things go wrong in it, from 300 on it is a match; a test that draws for
// itself takes any number, as it shares its seed with nobody.
//
// A number is part of every result that was drawn from it: add new ones at the end, and change none.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace striker::sil::random_stream {

inline constexpr std::uint64_t ball = 1;        // index: the episode
inline constexpr std::uint64_t pose = 2;        // index: the episode
inline constexpr std::uint64_t conditions = 3;  // of a robot that is not the nominal one; index: the episode
inline constexpr std::uint64_t vision_noise = 4;  // that a training's camera adds; index: the episode
inline constexpr std::uint64_t weights = 101;     // the network that a training begins with
inline constexpr std::uint64_t exploration = 102;
inline constexpr std::uint64_t sampling = 103;      // from the replay buffer
inline constexpr std::uint64_t calibration = 104;   // random play before an export; index: the episode
inline constexpr std::uint64_t dummies = 105;       // inputs that say nothing; index: the episode
inline constexpr std::uint64_t bootstrap = 106;     // resampled runs of an experiment
inline constexpr std::uint64_t random_rival = 107;  // index: the episode
inline constexpr std::uint64_t guide = 108;     // whom a learner's guide leads, how far; index: the episode
inline constexpr std::uint64_t faults = 201;    // what a fault draws; index: the fault's own stream
inline constexpr std::uint64_t campaign = 202;  // which faults a campaign's run has; index: the run
inline constexpr std::uint64_t camera_noise = 203;  // of a camera
inline constexpr std::uint64_t match_jitter = 301;  // of the formations of a match
inline constexpr std::uint64_t match_slip = 302;    // of wheels in a match; index: the robot
inline constexpr std::uint64_t match_team = 303;    // the seed of a strategy; index: the team
inline constexpr std::uint64_t random_team = 310;   // the wheels of the team of that name

namespace detail {

consteval bool all_differ() {
  std::array numbers = {ball,         pose,       conditions,  vision_noise, weights,
                        exploration,  sampling,   calibration, dummies,      bootstrap,
                        random_rival, guide,      faults,      campaign,     camera_noise,
                        match_jitter, match_slip, match_team,  random_team};
  std::sort(numbers.begin(), numbers.end());
  return std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end();
}

}  // namespace detail

static_assert(detail::all_differ(), "two uses of randomness would draw the same numbers");

}  // namespace striker::sil::random_stream
