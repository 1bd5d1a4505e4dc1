// SPDX-License-Identifier: Apache-2.0
// An exported policy that a program reads at run time, in place of a compiler: for trying one without building.
//
// The header is taken at its word as little as the compiler takes it: sizes, ranges, the proof that no sum leaves 32
// bits, the identity and the golden vectors are checked before it plays (firmware/policy/proof.hpp). The arithmetic is
// the specification's (firmware/policy/policy.hpp), to the bit; a decision takes some 10 us.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "firmware/policy/policy.hpp"

namespace striker::sil {

struct LoadedLayer {
  std::vector<std::vector<std::int32_t>> weights;  // a row a neuron
  std::vector<std::int32_t> biases;
  std::uint8_t shift = 0;
};

struct LoadedGolden {
  std::vector<std::int32_t> raw;
  std::vector<std::int32_t> sums;
  std::uint8_t action = 0;
};

struct LoadedPolicy {
  std::string name;
  bool is_int8 = false;
  std::uint32_t identity = 0;
  std::uint32_t configuration_hash = 0;
  std::int32_t decision_period_ms = 0;
  std::vector<policy::StateInput> state;
  bool mirrored = false;
  std::vector<policy::InputScale> input_scales;
  std::vector<LoadedLayer> layers;  // the last one is the output
  std::vector<policy::WheelSetPoint> set_points;
  std::vector<LoadedGolden> golden_vectors;
};

// From a header that striker-export wrote. Throws std::runtime_error with one line that names the file, and what is
// wrong with it.
[[nodiscard]] LoadedPolicy read_policy_header(const std::filesystem::path& file);

// Throws std::runtime_error, beginning with `file`, for one that the compiler would refuse.
void require_sound(const LoadedPolicy& policy, const std::string& file);

// The output layer's sums for raw inputs, in the order and units of `policy.state`.
[[nodiscard]] std::vector<std::int32_t> sums_of(const LoadedPolicy& policy,
                                                std::span<const std::int32_t> raw);

// The greatest; of equals, the first.
[[nodiscard]] std::uint8_t choice_of(std::span<const std::int32_t> sums);

}  // namespace striker::sil
