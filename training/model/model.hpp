// SPDX-License-Identifier: Apache-2.0
// A trained Q network as a file: safetensors, float32, the layers named as PyTorch names those of
// Sequential(Linear, ReLU, Linear, ReLU, Linear): "0.weight" [64, 6], "0.bias" [64], "2.weight", ...
//
// Networks trained elsewhere are read too: any names that end in a number and ".weight" or ".bias", in
// ascending order, whatever stands before the number ("q_net.q_net.0.weight" of Stable-Baselines3,
// "network.0.weight" of CleanRL). Of several networks in a file, one whose name holds "target" is left out. A file whose
// name ends in .onnx is read as such (onnx.hpp): the same network is the same model.
// One to three hidden layers, as the firmware's header has them; deeper networks are refused.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include "training/learner/network.hpp"
#include "training/model/safetensors.hpp"

namespace striker::training {

struct Model {
  Parameters parameters;
  // What striker-train notes: "configuration" (the text, every key), "configuration_name", "seed",
  // "identity", "episodes", "mean_reward" where it was measured, and "history" (RunState) where the
  // configuration and the seed do not say all. A model from elsewhere may lack all.
  std::map<std::string, std::string> metadata;
};

// A file that has more is refused: some thousand times a kick network, and so much at most is read into memory.
inline constexpr std::size_t most_model_bytes = std::size_t{64} << 20U;

// Errors as `read_safetensors` or `read_onnx`; also a missing or doubtful tensor, or layers that do not fit together.
// `network` names one of several networks in the file, by the first parts of its tensors' names (network_names.hpp).
[[nodiscard]] Model load_model(const std::filesystem::path& file, const std::string& network = "");
// Throws, and writes nothing, if a weight is not finite: no program would read it.
void save_model(const Model& model, const std::filesystem::path& file);

// The layers as tensors, and back; errors name `file`.
[[nodiscard]] std::vector<Tensor> tensors_of(const Parameters& parameters);
[[nodiscard]] Parameters parameters_of(const std::vector<Tensor>& tensors, const std::string& file,
                                       const std::string& network = "");

// FNV-1a of the weights, layer by layer as in the file; printed as 8 hexadecimal digits.
[[nodiscard]] std::string model_identity(const Parameters& parameters);

}  // namespace striker::training
