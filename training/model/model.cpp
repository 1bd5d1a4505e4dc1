// SPDX-License-Identifier: Apache-2.0
#include "training/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "firmware/host/files.hpp"
#include "training/model/hash.hpp"

namespace striker::training {

namespace {

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// "q_net.0.weight" is layer 0 of the network "q_net.".
struct LayerName {
  std::string network;
  int number = -1;
  bool weight = false;
};

bool read_name(const std::string& name, LayerName& layer) {
  for (const std::string_view part : {".weight", ".bias"}) {
    if (!std::string_view(name).ends_with(part)) {
      continue;
    }
    const std::string_view stem = std::string_view(name).substr(0, name.size() - part.size());
    const std::size_t digits = stem.find_last_not_of("0123456789") + 1;  // npos + 1 is 0
    const auto [end, error] = std::from_chars(stem.data() + digits, stem.data() + stem.size(), layer.number);
    layer.network = stem.substr(0, digits);
    layer.weight = part == ".weight";
    return error == std::errc{} && end == stem.data() + stem.size();
  }
  return false;
}

struct LayerTensors {
  const Tensor* weight = nullptr;
  const Tensor* bias = nullptr;
};

using Layers = std::map<int, LayerTensors>;  // by number

// The only network of the file that is no target network.
Layers find_network(const std::vector<Tensor>& tensors, const std::string& file) {
  std::map<std::string, Layers> networks;
  for (const Tensor& tensor : tensors) {
    LayerName name;
    if (!read_name(tensor.name, name)) {
      throw std::runtime_error(
          fmt::format("{}: tensor {} is no layer of a network; the names are like 0.weight and 0.bias", file,
                      tensor.name));
    }
    if (name.network.find("target") == std::string::npos) {
      LayerTensors& layer = networks[name.network][name.number];
      (name.weight ? layer.weight : layer.bias) = &tensor;
    }
  }
  if (networks.size() != 1) {
    std::string names;
    for (const auto& [name, layers] : networks) {
      names += fmt::format(" \"{}\"", name);
    }
    throw std::runtime_error(
        fmt::format("{}: it holds {} networks ({} ), not one Q network", file, networks.size(), names));
  }
  return networks.begin()->second;
}

void require_shape(const Tensor& tensor, const std::vector<std::size_t>& shape, const std::string& file) {
  if (tensor.shape != shape) {
    throw std::runtime_error(fmt::format("{}: tensor {} has shape [{}], not [{}]", file, tensor.name,
                                         fmt::join(tensor.shape, ", "), fmt::join(shape, ", ")));
  }
}

// The layers in order, checked to fit together.
std::vector<LayerTensors> in_order(const Layers& layers, const std::string& file) {
  std::vector<LayerTensors> ordered;
  std::size_t inputs = 0;
  for (const auto& [number, layer] : layers) {
    if (layer.weight == nullptr || layer.bias == nullptr) {
      throw std::runtime_error(fmt::format("{}: tensor {}.{} is missing", file, number,
                                           layer.weight == nullptr ? "weight" : "bias"));
    }
    const std::size_t outputs = layer.bias->values.size();
    if (ordered.empty() && layer.weight->shape.size() == 2) {
      inputs = layer.weight->shape[1];
    }
    require_shape(*layer.weight, {outputs, inputs}, file);
    require_shape(*layer.bias, {outputs}, file);
    inputs = outputs;
    ordered.push_back(layer);
  }
  if (ordered.size() != layer_count) {
    throw std::runtime_error(fmt::format(
        "{}: it holds {} layers; a kick model has two hidden layers and an output layer: 0.weight, "
        "0.bias, 2.weight, 2.bias, 4.weight and 4.bias",
        file, ordered.size()));
  }
  return ordered;
}

}  // namespace

std::vector<Tensor> tensors_of(const Parameters& parameters) {
  std::vector<Tensor> tensors;
  for (int layer = 0; layer < layer_count; ++layer) {
    const RowMajor weights = parameters.weights(layer);
    const auto biases = parameters.biases(layer);
    const auto rows = static_cast<std::size_t>(weights.rows());
    tensors.push_back({.name = fmt::format("{}.weight", 2 * layer),
                       .shape = {rows, static_cast<std::size_t>(weights.cols())},
                       .values = {weights.data(), weights.data() + weights.size()}});
    tensors.push_back({.name = fmt::format("{}.bias", 2 * layer),
                       .shape = {rows},
                       .values = {biases.data(), biases.data() + biases.size()}});
  }
  return tensors;
}

Parameters parameters_of(const std::vector<Tensor>& tensors, const std::string& file) {
  const std::vector<LayerTensors> layers = in_order(find_network(tensors, file), file);
  const auto outputs = [&layers](std::size_t layer) {
    return static_cast<int>(layers[layer].bias->values.size());
  };
  Parameters parameters({.inputs = static_cast<int>(layers[0].weight->shape[1]),
                         .hidden1 = outputs(0),
                         .hidden2 = outputs(1),
                         .actions = outputs(2)});
  for (int layer = 0; layer < layer_count; ++layer) {
    const LayerTensors& from = layers[static_cast<std::size_t>(layer)];
    auto weights = parameters.weights(layer);
    auto biases = parameters.biases(layer);
    weights = Eigen::Map<const RowMajor>(from.weight->values.data(), weights.rows(), weights.cols());
    biases = Eigen::Map<const Eigen::VectorXf>(from.bias->values.data(), biases.size());
  }
  return parameters;
}

Model load_model(const std::filesystem::path& file) {
  const SafeTensors content = read_safetensors(host::read_file(file), file.string());
  return {.parameters = parameters_of(content.tensors, file.string()), .metadata = content.metadata};
}

void save_model(const Model& model, const std::filesystem::path& file) {
  host::write_file(file,
                   write_safetensors({.tensors = tensors_of(model.parameters), .metadata = model.metadata}));
}

std::string model_identity(const Parameters& parameters) {
  Fnv1a hash;
  for (const Tensor& tensor : tensors_of(parameters)) {
    for (const float value : tensor.values) {
      hash.add(value);
    }
  }
  return fmt::format("{:08x}", hash.value());
}

}  // namespace striker::training
