// A trained Q network as a file: safetensors, the layers named as PyTorch names those of
// Sequential(Linear, ReLU, Linear, ReLU, Linear): "0.weight" [64, 6], "0.bias" [64], "2.weight", ...
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "config.hpp"
#include "network.hpp"

namespace striker::training {

struct Model {
  Parameters parameters;
  // What striker-train notes: "configuration" (the text), "configuration_name", "equations", "seed",
  // "identity", "episodes", and "mean_reward" where it was measured. A model from elsewhere may lack all.
  std::map<std::string, std::string> metadata;
};

// Errors as `read_safetensors`; also a missing or unknown tensor or one of another shape.
[[nodiscard]] Model load_model(const std::filesystem::path& file);
void save_model(const Model& model, const std::filesystem::path& file);

// FNV-1a of the weights, layer by layer as in the file; printed as 8 hexadecimal digits.
[[nodiscard]] std::string model_identity(const Parameters& parameters);

// The equations that the model was trained with; corrected if it does not say.
[[nodiscard]] Equations equations_of(const Model& model);

}  // namespace striker::training
