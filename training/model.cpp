#include "model.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "files.hpp"
#include "hash.hpp"
#include "safetensors.hpp"

namespace striker::training {

namespace {

template <int L>
using RowMajorWeights = Eigen::Matrix<float, widths[L + 1], widths[L], Eigen::RowMajor>;

template <int L>
void add_layer(std::vector<Tensor>& tensors, const Parameters& parameters) {
  const RowMajorWeights<L> weight = weights<L>(parameters);
  const auto bias = biases<L>(parameters);
  const auto rows = static_cast<std::size_t>(weight.rows());
  tensors.push_back({.name = fmt::format("{}.weight", 2 * L),
                     .shape = {rows, static_cast<std::size_t>(weight.cols())},
                     .values = {weight.data(), weight.data() + weight.size()}});
  tensors.push_back({.name = fmt::format("{}.bias", 2 * L),
                     .shape = {rows},
                     .values = {bias.data(), bias.data() + bias.size()}});
}

std::vector<Tensor> tensors_of(const Parameters& parameters) {
  std::vector<Tensor> tensors;
  add_layer<0>(tensors, parameters);
  add_layer<1>(tensors, parameters);
  add_layer<2>(tensors, parameters);
  return tensors;
}

template <int L>
void take_layer(const std::vector<Tensor>& tensors, Parameters& parameters) {
  const std::size_t first = 2 * static_cast<std::size_t>(L);
  weights<L>(parameters) = Eigen::Map<const RowMajorWeights<L>>(tensors[first].values.data());
  biases<L>(parameters) = Eigen::Map<const BiasVector<L>>(tensors[first + 1].values.data());
}

// The tensors in the order that `tensors_of` gives, whatever order the file has them in.
std::vector<Tensor> in_order(const SafeTensors& content, const std::string& file) {
  std::vector<Tensor> ordered = tensors_of(Parameters::Zero());
  for (Tensor& wanted : ordered) {
    const Tensor* found = nullptr;
    for (const Tensor& tensor : content.tensors) {
      found = tensor.name == wanted.name ? &tensor : found;
    }
    if (found == nullptr) {
      throw std::runtime_error(
          fmt::format("{}: tensor {} is missing; a kick model has 0.weight, 0.bias, "
                      "2.weight, 2.bias, 4.weight and 4.bias",
                      file, wanted.name));
    }
    if (found->shape != wanted.shape) {
      throw std::runtime_error(fmt::format("{}: tensor {} has shape [{}], not [{}] as a kick model's", file,
                                           wanted.name, fmt::join(found->shape, ", "),
                                           fmt::join(wanted.shape, ", ")));
    }
    wanted = *found;
  }
  if (content.tensors.size() != ordered.size()) {
    throw std::runtime_error(fmt::format("{}: it holds {} tensors, a kick model has {}", file,
                                         content.tensors.size(), ordered.size()));
  }
  return ordered;
}

}  // namespace

Model load_model(const std::filesystem::path& file) {
  const SafeTensors content = read_safetensors(read_file(file), file.string());
  const std::vector<Tensor> tensors = in_order(content, file.string());
  Model model{.parameters = Parameters::Zero(), .metadata = content.metadata};
  take_layer<0>(tensors, model.parameters);
  take_layer<1>(tensors, model.parameters);
  take_layer<2>(tensors, model.parameters);
  return model;
}

void save_model(const Model& model, const std::filesystem::path& file) {
  write_file(file, write_safetensors({.tensors = tensors_of(model.parameters), .metadata = model.metadata}));
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

Equations equations_of(const Model& model) {
  const auto found = model.metadata.find("equations");
  const bool printed = found != model.metadata.end() && found->second == "printed";
  return printed ? Equations::printed : Equations::corrected;
}

}  // namespace striker::training
