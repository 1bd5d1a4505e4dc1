// SPDX-License-Identifier: Apache-2.0
#include "sil/policy/loaded_policy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "firmware/core/tick.hpp"
#include "firmware/policy/proof.hpp"

namespace striker::sil {

namespace {

using policy::proof::activation_limit;

constexpr std::size_t most_actions = 256;  // a golden vector's action is a byte

bool is_in(std::int64_t value, std::int64_t least, std::int64_t greatest) {
  return value >= least && value <= greatest;
}

bool fits_together(const LoadedPolicy& policy) {
  std::size_t inputs = policy.state.size();
  if (policy.input_scales.size() != inputs) {
    return false;
  }
  for (const LoadedLayer& layer : policy.layers) {
    const bool is_table =
        layer.weights.size() == layer.biases.size() && !layer.weights.empty() &&
        std::ranges::all_of(layer.weights, [&](const auto& row) { return row.size() == inputs; });
    if (!is_table) {
      return false;
    }
    inputs = layer.biases.size();
  }
  return inputs == policy.set_points.size() &&
         std::ranges::all_of(policy.golden_vectors, [&](const LoadedGolden& golden) {
           return golden.raw.size() == policy.state.size() && golden.sums.size() == inputs;
         });
}

bool is_in_range(const LoadedPolicy& policy) {
  const std::int64_t weight_limit = policy.is_int8 ? 127 : 32767;
  for (const LoadedLayer& layer : policy.layers) {
    const bool is_output = &layer == &policy.layers.back();
    if (!is_in(layer.shift, is_output ? 0 : 1, 30)) {
      return false;
    }
    for (const auto& row : layer.weights) {
      if (!std::ranges::all_of(row,
                               [&](auto weight) { return is_in(weight, -weight_limit - 1, weight_limit); })) {
        return false;
      }
    }
  }
  return std::ranges::all_of(policy.input_scales,
                             [](const policy::InputScale& scale) {
                               return is_in(scale.multiplier, 1, 1 << 20) && is_in(scale.shift, 1, 40);
                             }) &&
         std::ranges::all_of(policy.state, [](const policy::StateInput& input) {
           return input.decisions_ago <= policy::greatest_look_back;
         });
}

// The proof of firmware/policy/proof.hpp, layer by layer.
bool sums_fit(const LoadedPolicy& policy) {
  std::vector<std::int64_t> greatest(policy.state.size(), activation_limit);
  for (const LoadedLayer& layer : policy.layers) {
    const bool is_hidden = &layer != &policy.layers.back();
    const std::int64_t rounding = is_hidden ? std::int64_t{1} << (layer.shift - 1) : 0;
    std::vector<std::int64_t> next;
    for (std::size_t j = 0; j < layer.biases.size(); ++j) {
      std::int64_t sum = std::abs(std::int64_t{layer.biases[j]}) + rounding;
      for (std::size_t i = 0; i < greatest.size(); ++i) {
        sum += std::abs(std::int64_t{layer.weights[j][i]}) * greatest[i];
      }
      if (sum > policy::proof::sum_limit) {
        return false;
      }
      next.push_back(std::min(sum >> layer.shift, activation_limit));
    }
    greatest = next;
  }
  return true;
}

std::uint32_t identity_of(const LoadedPolicy& policy) {
  policy::proof::Fnv1a hash;
  hash.add(policy.configuration_hash);
  hash.add(policy.decision_period_ms);
  for (const auto& [element, ago] : policy.state) {
    hash.add(static_cast<std::uint8_t>(element));
    hash.add(ago);
  }
  hash.add(static_cast<std::uint8_t>(policy.mirrored));
  for (const auto& [multiplier, shift] : policy.input_scales) {
    hash.add(multiplier);
    hash.add(shift);
  }
  for (const LoadedLayer& layer : policy.layers) {
    for (const auto& row : layer.weights) {
      for (const std::int32_t weight : row) {
        policy.is_int8 ? hash.add(static_cast<std::int8_t>(weight))
                       : hash.add(static_cast<std::int16_t>(weight));
      }
    }
    std::ranges::for_each(layer.biases, [&](std::int32_t bias) { hash.add(bias); });
    hash.add(layer.shift);
  }
  for (const auto& [left, right] : policy.set_points) {
    hash.add(left);
    hash.add(right);
  }
  for (const LoadedGolden& golden : policy.golden_vectors) {
    std::ranges::for_each(golden.raw, [&](std::int32_t raw) { hash.add(raw); });
    std::ranges::for_each(golden.sums, [&](std::int32_t sum) { hash.add(sum); });
    hash.add(golden.action);
  }
  return hash.value();
}

}  // namespace

void require_sound(const LoadedPolicy& policy, const std::string& file) {
  const auto require = [&file](bool holds, const char* otherwise) {
    if (!holds) {
      throw std::runtime_error(fmt::format("{}: {}: export the model again", file, otherwise));
    }
  };
  require(!policy.state.empty() && policy.state.size() <= policy::greatest_inputs &&
              policy.set_points.size() >= 2 && policy.set_points.size() <= most_actions &&
              fits_together(policy),
          "its layers, inputs and actions do not fit together");
  require(is_in_range(policy), "a weight, a shift, a multiplier or an input is out of range");
  require(policy.decision_period_ms == core::decision_period_ms,
          "it was trained at another decision period than this controller's 50 ms");
  require(sums_fit(policy), "a 32-bit sum could overflow");
  require(identity_of(policy) == policy.identity, "it was altered after its export");
  require(!policy.golden_vectors.empty() &&
              std::ranges::all_of(policy.golden_vectors,
                                  [&](const LoadedGolden& golden) {
                                    const auto sums = sums_of(policy, golden.raw);
                                    return sums == golden.sums && choice_of(sums) == golden.action;
                                  }),
          "a golden vector is missing, or comes out different");
}

std::vector<std::int32_t> sums_of(const LoadedPolicy& policy, std::span<const std::int32_t> raw) {
  std::vector<std::int32_t> values;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const auto [multiplier, shift] = policy.input_scales[i];
    const std::int64_t scaled =
        (std::int64_t{raw[i]} * multiplier + (std::int64_t{1} << (shift - 1))) >> shift;
    values.push_back(
        static_cast<std::int32_t>(std::clamp<std::int64_t>(scaled, -activation_limit, activation_limit)));
  }
  for (const LoadedLayer& layer : policy.layers) {
    std::vector<std::int32_t> sums = layer.biases;
    for (std::size_t j = 0; j < sums.size(); ++j) {
      for (std::size_t i = 0; i < values.size(); ++i) {
        sums[j] += layer.weights[j][i] * values[i];
      }
      if (&layer != &policy.layers.back()) {
        const std::int64_t rounded =
            (std::int64_t{sums[j]} + (std::int64_t{1} << (layer.shift - 1))) >> layer.shift;
        sums[j] = static_cast<std::int32_t>(std::clamp<std::int64_t>(rounded, 0, activation_limit));
      }
    }
    values = sums;
  }
  return values;
}

std::uint8_t choice_of(std::span<const std::int32_t> sums) {
  return static_cast<std::uint8_t>(std::ranges::max_element(sums) - sums.begin());
}

}  // namespace striker::sil
