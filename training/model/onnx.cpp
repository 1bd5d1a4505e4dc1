// SPDX-License-Identifier: Apache-2.0
#include "training/model/onnx.hpp"

#include <fmt/format.h>

#include <onnx/onnx_pb.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "training/model/onnx_size.hpp"
#include "training/model/shown.hpp"

namespace striker::training {

namespace {

constexpr const char* supported =
    "a kick network is a chain of Gemm, or of MatMul and Add, with Relu between two layers, all FLOAT";

// What the chain came to; `product`: a MatMul whose Add is to follow.
enum class Step { nothing, product, layer, relu };

bool is_onnx_domain(const std::string& domain) {
  return domain.empty() || domain == "ai.onnx";
}

// Walks the chain from the graph's input to its output.
class Chain {
 public:
  Chain(const onnx::GraphProto& graph, std::string file) : graph_(graph), file_(std::move(file)) {
    if (graph.node_size() > most_nodes) {
      refuse(fmt::format("it has {} nodes; at most {} are read", graph.node_size(), most_nodes));
    }
    for (const onnx::TensorProto& tensor : graph.initializer()) {
      note_name(tensor.name());
      constants_[tensor.name()] = &tensor;
    }
    for (const onnx::NodeProto& node : graph.node()) {
      std::ranges::for_each(node.output(), [this](const std::string& name) { note_name(name); });
      add_constant(node);
    }
  }

  std::vector<Tensor> layers() {
    value_ = input();
    for (int left = graph_.node_size() + 1; !is_output(value_); --left) {
      if (left == 0) {
        refuse("its nodes go in a circle");
      }
      take(next());
    }
    if (last_ != Step::layer) {
      refuse("it does not end with a whole layer");
    }
    return std::move(tensors_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}; {}", file_, shown(what), supported));
  }

  [[noreturn]] void refuse(const onnx::NodeProto& node, const std::string& why) const {
    constexpr std::size_t longest = 80;
    const bool is_named = !node.name().empty() || node.output_size() == 0;
    refuse(fmt::format("node {} ({}) {}", shown(is_named ? node.name() : node.output(0), longest),
                       shown(node.op_type(), longest), why));
  }

  // A value is made once, so that there is one that a name means.
  void note_name(const std::string& name) {
    if (!name.empty() && !names_.insert(name).second) {
      refuse(fmt::format("{} is there twice, so that it is not clear which one is meant", name));
    }
  }

  // A constant's name, or another one for it: PyTorch writes equal biases once, and an Identity for each further one.
  void add_constant(const onnx::NodeProto& node) {
    if (node.output_size() != 1) {
      return;
    }
    if (node.op_type() == "Constant") {
      const auto* const value = attribute_of(node, "value", onnx::AttributeProto::TENSOR);
      if (value != nullptr) {
        constants_[node.output(0)] = &value->t();
      }
    } else if (node.op_type() == "Identity" && node.input_size() == 1 && constants_.contains(node.input(0))) {
      constants_[node.output(0)] = constants_.at(node.input(0));
    }
  }

  [[nodiscard]] std::string input() const {
    std::string name;
    for (const onnx::ValueInfoProto& value : graph_.input()) {
      if (constants_.contains(value.name())) {
        continue;  // older files list initialisers among the inputs
      }
      if (!name.empty()) {
        refuse(fmt::format("it has the inputs {} and {}, not one", name, value.name()));
      }
      name = value.name();
    }
    if (name.empty() || graph_.output_size() != 1) {
      refuse(fmt::format("it has {} outputs and {} input, not one of each", graph_.output_size(),
                         name.empty() ? "no" : "one"));
    }
    return name;
  }

  [[nodiscard]] bool is_output(const std::string& value) const { return graph_.output(0).name() == value; }

  // The only node that reads the value.
  [[nodiscard]] const onnx::NodeProto& next() const {
    const onnx::NodeProto* found = nullptr;
    for (const onnx::NodeProto& node : graph_.node()) {
      if (std::ranges::find(node.input(), value_) == node.input().end()) {
        continue;
      }
      if (found != nullptr) {
        refuse(node, fmt::format("reads {}, as another node does: that is no chain", value_));
      }
      found = &node;
    }
    if (found == nullptr || found->output_size() != 1) {
      refuse(fmt::format("no node makes one value of {}", value_));
    }
    return *found;
  }

  void take(const onnx::NodeProto& node) {
    const std::string& kind = node.op_type();
    if (!is_onnx_domain(node.domain())) {
      refuse(node, fmt::format("is of {}, not ONNX's own", node.domain()));
    }
    if (last_ == Step::product && kind != "Add") {
      refuse(node, "follows a MatMul, where its Add should be");
    }
    if (kind == "Gemm" && node.input_size() == 3) {
      take_gemm(node);
    } else if (kind == "MatMul" && node.input_size() == 2) {
      take_weight(node, false);
      last_ = Step::product;
    } else if (kind == "Add" && node.input_size() == 2 && last_ == Step::product) {
      take_bias(node, node.input(node.input(0) == value_ ? 1 : 0));
    } else if (kind == "Relu" && last_ == Step::layer) {
      last_ = Step::relu;
    } else if (!(kind == "Identity" ||
                 (kind == "Flatten" && last_ == Step::nothing && number_of(node, "axis", 1) == 1))) {
      refuse(node, "is not read here");
    }
    value_ = node.output(0);
  }

  void take_gemm(const onnx::NodeProto& node) {
    for (const char* const factor : {"alpha", "beta"}) {
      if (factor_of(node, factor) != 1.0F) {
        refuse(node, fmt::format("has {} other than 1", factor));
      }
    }
    if (number_of(node, "transA", 0) != 0) {
      refuse(node, "has transA");
    }
    take_weight(node, number_of(node, "transB", 0) != 0);
    take_bias(node, node.input(2));
  }

  // As PyTorch has it: [outputs, inputs].
  void take_weight(const onnx::NodeProto& node, bool is_transposed) {
    if (last_ == Step::layer) {
      refuse(node, "follows a layer without a Relu between");
    }
    if (node.input(0) != value_) {
      refuse(node, "multiplies by what it reads from the left");
    }
    Tensor weight = constant(node, node.input(1));
    if (weight.shape.size() != 2) {
      refuse(node, fmt::format("has a weight of {} dimensions, not 2", weight.shape.size()));
    }
    if (!is_transposed) {
      weight = transposed(weight);
    }
    if (tensors_.size() == std::size_t{2} * most_layers) {
      refuse(fmt::format("it has more than {} layers, and a kick network one, two or three hidden layers",
                         most_layers));
    }
    weight.name = fmt::format("{}.weight", tensors_.size());
    tensors_.push_back(std::move(weight));
  }

  void take_bias(const onnx::NodeProto& node, const std::string& name) {
    Tensor bias = constant(node, name);
    const std::size_t last = bias.shape.empty() ? 0 : bias.shape.back();
    if (last != bias.values.size()) {
      refuse(node,
             fmt::format("has a bias of shape [{}], not one value an output", fmt::join(bias.shape, ", ")));
    }
    bias.shape = {last};
    bias.name = fmt::format("{}.bias", tensors_.size() - 1);
    tensors_.push_back(std::move(bias));
    last_ = Step::layer;
  }

  [[nodiscard]] static Tensor transposed(const Tensor& from) {
    Tensor to{.name = from.name, .shape = {from.shape[1], from.shape[0]}, .values = from.values};
    for (std::size_t row = 0; row < to.shape[0]; ++row) {
      for (std::size_t column = 0; column < to.shape[1]; ++column) {
        to.values[row * to.shape[1] + column] = from.values[column * from.shape[1] + row];
      }
    }
    return to;
  }

  [[nodiscard]] Tensor constant(const onnx::NodeProto& node, const std::string& name) const {
    const auto found = constants_.find(name);
    if (found == constants_.end()) {
      refuse(node, fmt::format("reads {}, which is no constant of the file", name));
    }
    const onnx::TensorProto& from = *found->second;
    if (from.data_type() != onnx::TensorProto::FLOAT || from.data_location() == onnx::TensorProto::EXTERNAL) {
      refuse(node, fmt::format("reads {}, which is not FLOAT, or lies in another file", name));
    }
    Tensor tensor{.name = name, .shape = {}, .values = {from.float_data().begin(), from.float_data().end()}};
    std::size_t count = 1;
    for (const std::int64_t size : from.dims()) {
      tensor.shape.push_back(static_cast<std::size_t>(std::max<std::int64_t>(size, 0)));
      count = std::min<std::size_t>(count * std::min<std::size_t>(tensor.shape.back(), most), most);
    }
    if (from.has_raw_data()) {
      if (from.raw_data().size() % sizeof(float) != 0) {
        refuse(node, fmt::format("reads {}, whose {} bytes are no whole number of FLOAT", name,
                                 from.raw_data().size()));
      }
      tensor.values.resize(from.raw_data().size() / sizeof(float));
      std::memcpy(tensor.values.data(), from.raw_data().data(), tensor.values.size() * sizeof(float));
    }
    if (tensor.values.size() != count) {
      refuse(node, fmt::format("reads {}, whose {} values do not fit its shape [{}]", name,
                               tensor.values.size(), fmt::join(tensor.shape, ", ")));
    }
    if (!std::ranges::all_of(tensor.values, [](float value) { return std::isfinite(value); })) {
      refuse(node, fmt::format("reads {}, which holds NaN or infinite values", name));
    }
    return tensor;
  }

  // Null if the node has none of that name. One of another type would be read as 0.
  [[nodiscard]] const onnx::AttributeProto* attribute_of(const onnx::NodeProto& node, const std::string& name,
                                                         onnx::AttributeProto::AttributeType type) const {
    const onnx::AttributeProto* found = nullptr;
    for (const onnx::AttributeProto& attribute : node.attribute()) {
      if (attribute.name() != name) {
        continue;
      }
      if (found != nullptr || attribute.type() != type) {
        refuse(node, fmt::format("has {} twice, or of another type than ONNX's", name));
      }
      found = &attribute;
    }
    return found;
  }

  [[nodiscard]] std::int64_t number_of(const onnx::NodeProto& node, const std::string& name,
                                       std::int64_t otherwise) const {
    const auto* const found = attribute_of(node, name, onnx::AttributeProto::INT);
    return found == nullptr ? otherwise : found->i();
  }

  [[nodiscard]] float factor_of(const onnx::NodeProto& node, const std::string& name) const {
    const auto* const found = attribute_of(node, name, onnx::AttributeProto::FLOAT);
    return found == nullptr ? 1.0F : found->f();
  }

  static constexpr int most_nodes = 1000;  // a kick network has a dozen; each is looked for among all
  static constexpr int most_layers = 8;    // so many are copied, before model.cpp counts them
  static constexpr std::size_t most = 1'000'000'000;  // values: more than any file that is read

  const onnx::GraphProto& graph_;
  std::string file_;
  std::set<std::string> names_;  // of all values
  std::map<std::string, const onnx::TensorProto*> constants_;
  std::string value_;
  std::vector<Tensor> tensors_;
  Step last_ = Step::nothing;
};

}  // namespace

SafeTensors read_onnx(std::string_view bytes, const std::string& file) {
  constexpr std::size_t most_beside_numbers = std::size_t{1} << 20U;
  if (const std::size_t rest = onnx_bytes_beside_numbers(bytes); rest > most_beside_numbers) {
    throw std::runtime_error(
        fmt::format("{}: it has {} bytes of names, nodes and notes, or is damaged; at most {} are read; {}",
                    file, rest, most_beside_numbers, supported));
  }
  onnx::ModelProto model;
  if (!model.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())) || !model.has_graph()) {
    throw std::runtime_error(fmt::format("{}: it is no ONNX file, or a damaged one; {}", file, supported));
  }
  for (const onnx::FunctionProto& function : model.functions()) {
    if (is_onnx_domain(function.domain())) {
      throw std::runtime_error(
          fmt::format("{}: it says itself what {} is; {}", file, shown(function.name()), supported));
    }
  }
  SafeTensors content{.tensors = Chain(model.graph(), file).layers(), .metadata = {}};
  for (const onnx::StringStringEntryProto& note : model.metadata_props()) {
    content.metadata[note.key()] = note.value();
  }
  return content;
}

}  // namespace striker::training
