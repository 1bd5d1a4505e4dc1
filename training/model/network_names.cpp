// SPDX-License-Identifier: Apache-2.0
#include "training/model/network_names.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace striker::training {

namespace {

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

// "model", "model." and "model.model" begin "model.model.", "mod" does not.
bool begins_with_parts(std::string_view network, std::string_view wanted) {
  if (!network.starts_with(wanted)) {
    return false;
  }
  const std::string_view rest = network.substr(wanted.size());
  return rest.empty() || rest.front() == '.' || wanted.ends_with('.');
}

using Networks = std::map<std::string, std::map<int, LayerTensors>>;

Networks networks_of(const std::vector<Tensor>& tensors, const std::string& file, bool only_layers) {
  Networks networks;
  for (const Tensor& tensor : tensors) {
    LayerName name;
    if (read_name(tensor.name, name)) {
      LayerTensors& layer = networks[name.network][name.number];
      const Tensor*& place = name.weight ? layer.weight : layer.bias;
      if (place != nullptr) {
        throw std::runtime_error(fmt::format("{}: tensors {} and {} are both {} of layer {}: leave one out",
                                             file, place->name, tensor.name, name.weight ? "weight" : "bias",
                                             name.number));
      }
      place = &tensor;
    } else if (only_layers) {
      throw std::runtime_error(fmt::format(
          "{}: tensor {} is no layer of a network; the names are like 0.weight and 0.bias; if the "
          "network is there beside it, name it with --network",
          file, tensor.name));
    }
  }
  return networks;
}

std::string listed(const Networks& networks) {
  constexpr std::size_t enough = 500;
  std::string names;
  for (const auto& [name, layers] : networks) {
    if (names.size() > enough) {
      return names + ", ...";
    }
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
  }
  return names.empty() ? "none" : names;
}

}  // namespace

NamedNetwork find_network(const std::vector<Tensor>& tensors, const std::string& file,
                          const std::string& wanted) {
  const Networks networks = networks_of(tensors, file, wanted.empty());
  Networks chosen;
  for (const auto& [name, layers] : networks) {
    if (wanted.empty() ? name.find("target") == std::string::npos : begins_with_parts(name, wanted)) {
      chosen[name] = layers;
    }
  }
  if (chosen.size() == 1) {
    return {.name = chosen.begin()->first, .layers = std::move(chosen.begin()->second)};
  }
  if (networks.empty()) {
    throw std::runtime_error(fmt::format(
        "{}: it holds no network; the tensors' names are like 0.weight and 0.bias, in float32", file));
  }
  if (wanted.empty()) {
    throw std::runtime_error(fmt::format(
        "{}: it holds {} networks ({}), not one Q network; name the one that is meant: --network \"{}\"",
        file, networks.size(), listed(networks), networks.begin()->first));
  }
  throw std::runtime_error(fmt::format("{}: --network {}: {} of its networks begin with that; it holds {}",
                                       file, wanted, chosen.empty() ? "none" : "several", listed(networks)));
}

}  // namespace striker::training
