// SPDX-License-Identifier: Apache-2.0
#include "training/model/model.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "firmware/host/files.hpp"
#include "training/model/hash.hpp"
#include "training/model/network_names.hpp"
#include "training/model/onnx.hpp"

namespace striker::training {

namespace {

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

[[noreturn]] void refuse_shape(const Tensor& tensor, const std::string& file, const std::string& why) {
  throw std::runtime_error(
      fmt::format("{}: tensor {} has shape [{}]{}", file, tensor.name, fmt::join(tensor.shape, ", "), why));
}

// A weight is [outputs, inputs]; of the first layer (`inputs` 0) the inputs are what the weight says.
void require_weight(const LayerTensors& layer, std::size_t inputs, const std::string& file) {
  const Tensor& weight = *layer.weight;
  const std::size_t outputs = layer.bias->values.size();
  const bool table = weight.shape.size() == 2;
  if (table && weight.shape[1] == 0) {
    refuse_shape(weight, file, "; a network reads one input at least");
  }
  if (table && weight.shape[0] == outputs && (inputs == 0 || weight.shape[1] == inputs)) {
    return;
  }
  const std::string wanted = inputs == 0 ? "inputs" : std::to_string(inputs);
  if (table && weight.shape[1] == outputs && (inputs == 0 || weight.shape[0] == inputs)) {
    refuse_shape(
        weight, file,
        fmt::format(", but {} has {} values: it is transposed; a weight is [outputs, inputs], as PyTorch "
                    "has it, here [{}, {}]; save its transpose (Keras and Flax hold [inputs, outputs])",
                    layer.bias->name, outputs, outputs, weight.shape[0]));
  }
  refuse_shape(weight, file,
               fmt::format(", not [{}, {}]: {} has {} values{}", outputs, wanted, layer.bias->name, outputs,
                           inputs == 0 ? "" : fmt::format(", the layer before it {}", inputs)));
}

// The layers in order, checked to fit together.
std::vector<LayerTensors> in_order(const NamedNetwork& network, const std::string& file) {
  std::vector<LayerTensors> ordered;
  std::size_t inputs = 0;
  for (const auto& [number, layer] : network.layers) {
    if (layer.weight == nullptr || layer.bias == nullptr) {
      throw std::runtime_error(fmt::format("{}: tensor {}{}.{} is missing", file, network.name, number,
                                           layer.weight == nullptr ? "weight" : "bias"));
    }
    if (layer.bias->shape.size() != 1 || layer.bias->values.empty()) {
      refuse_shape(*layer.bias, file, "; a bias is a list, one value an output");
    }
    require_weight(layer, inputs, file);
    inputs = layer.bias->values.size();
    ordered.push_back(layer);
  }
  if (ordered.size() != layer_count && ordered.size() != layer_count - 1) {
    throw std::runtime_error(fmt::format(
        "{}: it holds {} layers; a kick model has one or two hidden layers and an output layer: 0.weight, "
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

Parameters parameters_of(const std::vector<Tensor>& tensors, const std::string& file,
                         const std::string& network) {
  const std::vector<LayerTensors> layers = in_order(find_network(tensors, file, network), file);
  // After a ReLU the identity and another one change nothing, to the bit.
  const bool adds_identity = layers.size() == layer_count - 1;
  const auto outputs = [&layers](std::size_t layer) {
    return static_cast<int>(layers[layer].bias->values.size());
  };
  Parameters parameters({.inputs = static_cast<int>(layers[0].weight->shape[1]),
                         .hidden1 = outputs(0),
                         .hidden2 = outputs(adds_identity ? 0 : 1),
                         .actions = outputs(layers.size() - 1)});
  for (int layer = 0; layer < layer_count; ++layer) {
    auto weights = parameters.weights(layer);
    auto biases = parameters.biases(layer);
    if (adds_identity && layer == 1) {
      weights.setIdentity();
      biases.setZero();
      continue;
    }
    const LayerTensors& from =
        layers[static_cast<std::size_t>(adds_identity && layer > 1 ? layer - 1 : layer)];
    weights = Eigen::Map<const RowMajor>(from.weight->values.data(), weights.rows(), weights.cols());
    biases = Eigen::Map<const Eigen::VectorXf>(from.bias->values.data(), biases.size());
  }
  return parameters;
}

Model load_model(const std::filesystem::path& file, const std::string& network) {
  const bool is_onnx = file.extension() == ".onnx";
  if (is_onnx && !network.empty()) {
    throw std::runtime_error(
        fmt::format("{}: an ONNX file holds one network; leave --network {} out", file.string(), network));
  }
  const std::string bytes = host::read_file(file, most_model_bytes);
  const SafeTensors content =
      is_onnx ? read_onnx(bytes, file.string()) : read_safetensors(bytes, file.string());
  return {.parameters = parameters_of(content.tensors, file.string(), network), .metadata = content.metadata};
}

void save_model(const Model& model, const std::filesystem::path& file) {
  if (!all_finite(model.parameters.values)) {
    throw std::runtime_error(
        fmt::format("{}: not written: the network holds NaN or infinite weights; train anew with a lower "
                    "optimiser.learning_rate",
                    file.string()));
  }
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
