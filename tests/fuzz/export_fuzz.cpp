// SPDX-License-Identifier: Apache-2.0
// What striker-export is given: a network of any finite weights is refused in words, or becomes an integer network
// that fits the firmware's proof and computes without overflow.
#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/fuzz/support/bytes.hpp"
#include "training/export/quantise.hpp"
#include "training/task/task_config.hpp"

namespace striker::fuzz {
namespace {

// A model file holds neither NaN nor infinity (safetensors.hpp).
float finite_float(Bytes& bytes) {
  const auto value = std::bit_cast<float>(bytes.u32());
  return std::isfinite(value) ? value : 0.0F;
}

training::Parameters some_parameters(Bytes& bytes, int inputs) {
  const auto size = [&bytes] { return 1 + bytes.u8() % 8; };
  training::Shape shape{.inputs = inputs, .hidden = {}, .actions = 1 + size()};
  for (int more = bytes.u8() % 3; more >= 0; --more) {
    shape.hidden.push_back(size());
  }
  training::Parameters parameters(shape);
  for (int layer = 0; layer < parameters.shape().layers(); ++layer) {
    for (float& weight : parameters.weights(layer).reshaped()) {
      weight = finite_float(bytes);
    }
    for (float& bias : parameters.biases(layer).reshaped()) {
      bias = finite_float(bytes);
    }
  }
  return parameters;
}

// The first is one that play meets: no calibration is without motion.
std::vector<training::RawState> some_states(Bytes& bytes, std::size_t inputs) {
  std::vector<training::RawState> states(1, training::RawState(inputs, 1000));
  for (int more = bytes.u8() % 4; more > 0; --more) {
    training::RawState& state = states.emplace_back();
    for (std::size_t i = 0; i < inputs; ++i) {
      state.push_back(bytes.i16());
    }
  }
  return states;
}

void check_layers(const training::Quantised& quantised, const std::vector<training::RawState>& states) {
  for (const training::LayerBound& bound : training::bound_layers(quantised.network)) {
    require(bound.fits(), "no input drives a sum out of 32 bits");
  }
  for (const training::RawState& state : states) {
    require(training::evaluate(quantised.network, state).action < quantised.network.layers.back().outputs(),
            "an action is one of the network's");
  }
}

}  // namespace
}  // namespace striker::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace striker;
  fuzz::Bytes bytes(data, size);
  const auto weights = bytes.u8() % 2 == 0 ? training::WeightType::int16 : training::WeightType::int8;
  const training::StateInputs inputs = training::rcs_inputs();
  const auto states = fuzz::some_states(bytes, inputs.size());
  const auto parameters = fuzz::some_parameters(bytes, static_cast<int>(inputs.size()));
  try {
    fuzz::check_layers(training::quantise(parameters, inputs, states, weights), states);
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}
