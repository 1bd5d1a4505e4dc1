// SPDX-License-Identifier: Apache-2.0
#include "training/export/golden_vectors.hpp"

#include <limits>

namespace striker::training {

namespace {

// Every input saturates: all up, all down, and in turn. Only some values are possible for an angle.
std::vector<RawState> extreme_states(const StateInputs& inputs) {
  std::vector<RawState> states;
  for (const unsigned pattern : {0b00U, 0b11U, 0b10U, 0b01U}) {
    RawState state;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const bool low = ((pattern >> (i % 2)) & 1U) != 0;
      if (inputs[i].element == Element::ball_angle) {
        state.push_back(low ? std::numeric_limits<std::int16_t>::min()
                            : std::numeric_limits<std::int16_t>::max());
      } else {
        state.push_back(low ? std::numeric_limits<std::int32_t>::min()
                            : std::numeric_limits<std::int32_t>::max());
      }
    }
    states.push_back(state);
  }
  return states;
}

}  // namespace

std::vector<GoldenVector> golden_vectors(const IntegerNetwork& network, const StateInputs& inputs,
                                         const std::vector<RawState>& met) {
  std::vector<RawState> states = extreme_states(inputs);
  const std::size_t from_play = golden_count - states.size();
  for (std::size_t i = 0; i < from_play; ++i) {
    states.push_back(met[i * met.size() / from_play]);
  }
  std::vector<GoldenVector> goldens;
  goldens.reserve(states.size());
  for (const RawState& state : states) {
    goldens.push_back({.raw = state, .answer = evaluate(network, state)});
  }
  return goldens;
}

}  // namespace striker::training
