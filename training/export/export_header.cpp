// SPDX-License-Identifier: Apache-2.0
#include "training/export/export_header.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "training/model/hash.hpp"

namespace striker::training {

namespace {

constexpr std::size_t line_length = 110;

void add_layer(Fnv1a& hash, const IntegerLayer& layer, WeightType type) {
  for (const std::int16_t weight : layer.weights) {
    if (type == WeightType::int8) {
      hash.add(static_cast<std::int8_t>(weight));
    } else {
      hash.add(weight);
    }
  }
  for (const std::int32_t bias : layer.biases) {
    hash.add(bias);
  }
  hash.add(static_cast<std::uint8_t>(layer.shift));
}

// "{{1, 2, 3}}" as std::array wants it, from this column on, broken over lines.
template <class Numbers>
std::string array_of(const Numbers& numbers, std::size_t column) {
  constexpr std::size_t indent = 12;
  std::string text = "{{";
  column += text.size();
  for (std::size_t i = 0; i < std::size(numbers); ++i) {
    std::string number = fmt::format("{}{}", numbers[i], i + 1 < std::size(numbers) ? "," : "}}");
    if (column + number.size() + 2 > line_length) {
      text += '\n';
      text.append(indent, ' ');
      column = indent;
    } else if (i > 0) {
      text += ' ';
      ++column;
    }
    text += number;
    column += number.size();
  }
  return text;
}

std::string layer_text(const std::string& name, const IntegerLayer& layer) {
  std::string text = fmt::format("    .{} = {{\n        .weights = {{{{\n", name);
  for (std::size_t neuron = 0; neuron < layer.outputs(); ++neuron) {
    text += fmt::format("            {},\n", array_of(layer.row(neuron), 12));
  }
  text += fmt::format("        }}}},\n        .biases = {},\n        .shift = {},\n    }},\n",
                      array_of(layer.biases, 18), layer.shift);
  return text;
}

// Inputs, the outputs of each layer, golden vectors, and the weights' type where it is not int16.
std::string parameters_of(const ExportedPolicy& policy) {
  std::string text = std::to_string(policy.network.input_scales.size());
  for (const IntegerLayer& layer : policy.network.layers) {
    text += fmt::format(", {}", layer.outputs());
  }
  text += fmt::format(", {}", policy.golden_vectors.size());
  return text + (policy.network.weights == WeightType::int8 ? ", std::int8_t" : "");
}

const char* type_of(std::size_t hidden_layers) {
  return hidden_layers == 1 ? "Policy1" : hidden_layers == 2 ? "Policy" : "Policy3";
}

std::string inputs_text(const ExportedPolicy& policy) {
  std::string elements;
  std::string scales;
  for (std::size_t i = 0; i < policy.inputs.size(); ++i) {
    const auto [element, ago] = policy.inputs[i];
    const InputScale& scale = policy.network.input_scales[i];
    elements += fmt::format("        {{.element = StateElement::{}, .decisions_ago = {}}},\n",
                            facts_of(element).name, ago);
    scales += fmt::format("        {{.multiplier = {}, .shift = {}}},\n", scale.multiplier, scale.shift);
  }
  return fmt::format(
      "    .state = {{{{\n{}    }}}},\n    .mirrored = {},\n    .input_scales = {{{{\n{}    }}}},\n",
      elements, policy.one_sided, scales);
}

std::int32_t mm_s(double speed_m_s) {
  return static_cast<std::int32_t>(std::lround(speed_m_s * 1e3));
}

std::string set_points_text(const std::vector<SetPoint>& actions) {
  std::string text = "    .set_points = {{\n";
  for (const SetPoint& action : actions) {
    text += fmt::format("        {{.left_mm_s = {}, .right_mm_s = {}}},\n", mm_s(action.left_m_s),
                        mm_s(action.right_m_s));
  }
  return text + "    }},\n";
}

std::string goldens_text(const std::vector<GoldenVector>& goldens) {
  std::string text = "    .golden_vectors = {{\n";
  for (const GoldenVector& golden : goldens) {
    text += fmt::format("        {{.raw = {},\n         .sums = {},\n         .action = {}}},\n",
                        array_of(golden.raw, 16), array_of(golden.answer.sums, 17), golden.answer.action);
  }
  return text + "    }},\n";
}

}  // namespace

std::uint32_t identity_of(const ExportedPolicy& policy) {
  Fnv1a hash;
  hash.add(policy.configuration_hash);
  hash.add(policy.decision_period_ms);
  for (const StateInput& input : policy.inputs) {
    hash.add(static_cast<std::uint8_t>(input.element));
    hash.add(static_cast<std::uint8_t>(input.decisions_ago));
  }
  hash.add(static_cast<std::uint8_t>(policy.one_sided));
  for (const InputScale& scale : policy.network.input_scales) {
    hash.add(scale.multiplier);
    hash.add(static_cast<std::uint8_t>(scale.shift));
  }
  for (const IntegerLayer& layer : policy.network.layers) {
    add_layer(hash, layer, policy.network.weights);
  }
  for (const SetPoint& action : policy.actions) {
    hash.add(mm_s(action.left_m_s));
    hash.add(mm_s(action.right_m_s));
  }
  for (const GoldenVector& golden : policy.golden_vectors) {
    for (const std::int32_t raw : golden.raw) {
      hash.add(raw);
    }
    for (const std::int32_t sum : golden.answer.sums) {
      hash.add(sum);
    }
    hash.add(static_cast<std::uint8_t>(golden.answer.action));
  }
  return hash.value();
}

std::string header_text(const ExportedPolicy& policy, const std::string& name,
                        const std::vector<std::string>& notes) {
  const auto& layers = policy.network.layers;
  std::string text;
  for (const std::string& note : notes) {
    text += note.empty() ? "//\n" : fmt::format("// {}\n", note);
  }
  text += "#pragma once\n\n#include \"firmware/policy/policy.hpp\"\n\nnamespace striker::policy {\n\n";
  text += "// clang-format off\n";
  text += fmt::format("inline constexpr {}<{}> {} = {{\n", type_of(layers.size() - 1), parameters_of(policy),
                      name);
  text += fmt::format("    .identity = 0x{:08X}U,\n    .configuration_hash = 0x{:08X}U,\n",
                      identity_of(policy), policy.configuration_hash);
  text += fmt::format("    .decision_period_ms = {},\n", policy.decision_period_ms);
  text += inputs_text(policy);
  for (std::size_t l = 0; l + 1 < layers.size(); ++l) {
    text += layer_text(fmt::format("layer{}", l + 1), layers[l]);
  }
  text += layer_text("output", layers.back());
  text += set_points_text(policy.actions);
  text += goldens_text(policy.golden_vectors);
  text += "};\n// clang-format on\n\n}  // namespace striker::policy\n";
  return text;
}

}  // namespace striker::training
