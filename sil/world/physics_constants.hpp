// SPDX-License-Identifier: Apache-2.0
// The constants of physics that more than one model of the world computes with.
#pragma once

namespace striker::sil {

inline constexpr double gravity_m_s2 = 9.81;

// Damping: of its linear and angular velocity a body keeps this share in 1 s (AI World Cup test_world).
inline constexpr double kept_after_1_s = 0.8;

// The same as a rate, -ln 0.8, and as the share that a physics step of 10 ms leaves, 0.8^0.01. C++20 has no
// constexpr logarithm; tests/world/physics_constants_test.cpp holds the three together.
inline constexpr double damping_per_s = 0.22314355131420976;
inline constexpr double kept_in_10_ms = 0.9977710522882823;

// Coulomb friction between a tyre and the floor.
inline constexpr double tyre_friction = 3.0;

// A contact that closes slower than this does not bounce.
inline constexpr double bounce_threshold_m_s = 0.01;

}  // namespace striker::sil
