// SPDX-License-Identifier: Apache-2.0
#include "training/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
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
  if (ordered.size() < 2 || ordered.size() > greatest_hidden_layers + 1) {
    throw std::runtime_error(fmt::format(
        "{}: it holds {} layer{}; a kick model has one, two or three hidden layers and an output layer: 0.weight, "
        "0.bias, 2.weight, 2.bias, ...",
        file, ordered.size(), ordered.size() == 1 ? "" : "s"));
  }
  return ordered;
}

}  // namespace

std::vector<Tensor> tensors_of(const Parameters& parameters) {
  std::vector<Tensor> tensors;
  for (int layer = 0; layer < parameters.shape().layers(); ++layer) {
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
  Shape shape{.inputs = static_cast<int>(layers.front().weight->shape[1]),
              .hidden = {},
              .actions = static_cast<int>(layers.back().bias->values.size())};
  for (std::size_t l = 0; l + 1 < layers.size(); ++l) {
    shape.hidden.push_back(static_cast<int>(layers[l].bias->values.size()));
  }
  Parameters parameters(shape);
  for (std::size_t l = 0; l < layers.size(); ++l) {
    auto weights = parameters.weights(static_cast<int>(l));
    auto biases = parameters.biases(static_cast<int>(l));
    weights = Eigen::Map<const RowMajor>(layers[l].weight->values.data(), weights.rows(), weights.cols());
    biases = Eigen::Map<const Eigen::VectorXf>(layers[l].bias->values.data(), biases.size());
  }
  return parameters;
}

Model load_model(const std::filesystem::path& file, const std::string& network) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char letter) { return std::tolower(letter); });
  const bool is_onnx = ending == ".onnx";
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
