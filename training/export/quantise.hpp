// SPDX-License-Identifier: Apache-2.0
// From the float network to the integer network of firmware/policy/policy.hpp.
//
// Scales are powers of two, one a layer. Activations: the greatest scale at which everything that was met in
// play (the calibration states), with a margin, stays below 2^15. Weights: the greatest scale at which they
// fit their type and no input whatever can drive a sum out of 32 bits (the proof of firmware/policy/proof.hpp). That
// leaves some weights few bits, so they are rounded with error feedback: the choices that plain rounding
// would change become several times fewer.
#pragma once

#include <span>
#include <vector>

#include "training/export/integer_network.hpp"
#include "training/learner/network.hpp"

namespace striker::training {

struct LayerReport {
  int weight_exponent = 0;      // an integer weight is the weight times 2^this
  int activation_exponent = 0;  // of what the layer stores; the last layer's sums: of Q
  double range_used = 0.0;      // the greatest activation met / 32767 (the last layer: greatest sum / 2^31)
  double headroom_bits = 0.0;   // log2(2^31 / the worst sum)
  double mean_error = 0.0;      // against float, over the calibration states, in units of Q or activation
  double greatest_error = 0.0;
};

struct Quantised {
  IntegerNetwork network;
  int input_exponent = 0;
  std::vector<LayerReport> layers;
};

// Throws std::runtime_error if no scale fits (weights so large that the proof fails at every scale): it names layer,
// tensor, row and value, and what to do. Tensors are numbered as in a model's file: 0, 2 and 4.
[[nodiscard]] Quantised quantise(const Parameters& parameters, const StateInputs& inputs,
                                 std::span<const RawState> calibration,
                                 WeightType weights = WeightType::int16);

}  // namespace striker::training
