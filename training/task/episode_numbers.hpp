// SPDX-License-Identifier: Apache-2.0
// Who plays which episodes of a seed. Evaluations number theirs from 0, as striker-sil does; every other use
// begins so far away that no evaluation meets it.
#pragma once

#include <cstdint>

namespace striker::training {

inline constexpr std::uint64_t first_training_episode = std::uint64_t{1} << 63;
inline constexpr std::uint64_t first_validation_episode = std::uint64_t{1} << 62;
inline constexpr std::uint64_t first_calibration_episode = std::uint64_t{1} << 61;
inline constexpr std::uint64_t first_reward_difference_episode = first_calibration_episode + 1'000'000;

}  // namespace striker::training
