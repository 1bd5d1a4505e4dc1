// SPDX-License-Identifier: Apache-2.0
// Which tensors of a file are the Q network. Layers are known by the number that ends their names:
// "q_net.q_net.0.weight" is layer 0 of the network "q_net.q_net.".
#pragma once

#include <map>
#include <string>
#include <vector>

#include "training/model/safetensors.hpp"

namespace striker::training {

struct LayerTensors {
  const Tensor* weight = nullptr;
  const Tensor* bias = nullptr;
};

struct NamedNetwork {
  std::string name;                    // what stands before the numbers, its dot included; may be empty
  std::map<int, LayerTensors> layers;  // by number
};

// Without a `wanted` the file's only network, but for those whose name holds "target"; every tensor must be a layer.
// With one, the network whose name begins with it, dotted part by dotted part ("model" is "model.model." but not
// "model_old."); then other tensors do not matter. Throws std::runtime_error with one line that lists the networks
// there are, if that is none or several. The tensors must outlive the result.
[[nodiscard]] NamedNetwork find_network(const std::vector<Tensor>& tensors, const std::string& file,
                                        const std::string& wanted);

}  // namespace striker::training
