// SPDX-License-Identifier: Apache-2.0
// A second policy that the controller accepts, beside the built-in one: weights that no training made, three
// actions that every role can drive, and a proof of its own, all by the compiler.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/policy/kernel/int16/portable.hpp"
#include "firmware/policy/network.hpp"
#include "firmware/policy/proof.hpp"
#include "tests/policy/synthetic_policy.hpp"

namespace striker::policy {

// As an exporter makes a policy: first the network, then what it answers, then the identity of all.
inline constexpr auto wander_network = [] {
  auto policy = synthetic_policy<6, 32, 32, 3>(21);
  policy.decision_period_ms = 50;
  policy.state = {{{StateElement::ball_x, 0},
                   {StateElement::ball_y, 0},
                   {StateElement::robot_speed, 0},
                   {StateElement::ball_vx, 0},
                   {StateElement::ball_vy, 0},
                   {StateElement::ball_angle, 2}}};
  policy.input_scales = {
      {{549756, 27}, {549756, 27}, {842150, 18}, {842150, 18}, {842150, 18}, {1048576, 22}}};
  policy.set_points = {{{1800, 1800}, {-900, 900}, {900, -900}}};
  return policy;
}();

inline constexpr auto wander = [] {
  auto policy = wander_network;
  constexpr std::array<std::int32_t, 6> raw = {681792, 85184, 551, -1416, 76, 32211};
  const auto answer = infer<wander_network, kernel::int16::Portable>(raw);
  policy.golden_vectors[0] = {raw, answer.sums, answer.action};
  policy.identity = identity_of(policy);
  return policy;
}();

}  // namespace striker::policy
