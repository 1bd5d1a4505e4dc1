// SPDX-License-Identifier: Apache-2.0
#include "training/export/export_report.hpp"
#include "firmware/host/version.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "training/export/comparison/optional_json.hpp"

namespace striker::training {

namespace {

std::string noted(const Model& model, const std::string& key) {
  const auto found = model.metadata.find(key);
  return found == model.metadata.end() ? "" : found->second;
}

// Where the float network is from, as far as its file says it and its weights agree.
std::vector<std::string> origin_of(const Model& model) {
  const std::string identity = model_identity(model.parameters);
  const std::string configuration = noted(model, "configuration_name");
  const std::string seed = noted(model, "seed");
  if (configuration.empty() || seed.empty()) {
    std::vector<std::string> notes{
        "From a network whose file names no training of striker-train: where it is from, and what it was",
        fmt::format("trained for, is not known here. The float model's identity is {}.", identity)};
    if (noted(model, "format") == "pt") {
      notes.emplace_back("The file says that it was saved from PyTorch.");
    }
    return notes;
  }
  if (const std::string named = noted(model, "identity"); !named.empty() && named != identity) {
    return {
        fmt::format("From a file of striker-train, configuration \"{}\", seed {}, whose weights were changed",
                    configuration, seed),
        fmt::format("since: they had the identity {}, and the float model's identity is {}.", named,
                    identity)};
  }
  std::vector<std::string> notes{fmt::format(
      "Trained by striker-train, configuration \"{}\", seed {}; the float model's identity is {}.",
      configuration, seed, identity)};
  if (!noted(model, "history").empty()) {
    notes.emplace_back(
        "Configuration and seed do not say all of it: see \"history\" in the model's metadata.");
  }
  if (const std::string reward = noted(model, "mean_reward"); !reward.empty()) {
    notes.push_back(
        fmt::format("Mean reward of the float network on its validation episodes, servo plant: {}.", reward));
  }
  return notes;
}

}  // namespace

std::string header_of(const Export& exported, const Model& model, const std::string& name) {
  std::vector<std::string> notes{
      fmt::format(
          "The {} policy: an integer Q network, written by striker-export. Do not edit: an altered number does",
          name),
      "not compile. Format and arithmetic: firmware/policy/policy.hpp.", ""};
  for (const std::string& note : origin_of(model)) {
    notes.push_back(note);
  }
  notes.emplace_back();
  notes.push_back(fmt::format("Inputs are stored times 2^{}.", exported.quantised.input_exponent));
  const auto& layers = exported.quantised.layers;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    notes.push_back(fmt::format(
        "Layer {}: weights times 2^{}, results after the shift times 2^{}, "
        "{:.2f} bits of headroom.",
        l + 1, layers[l].weight_exponent, layers[l].activation_exponent, layers[l].headroom_bits));
  }
  return header_text(exported.policy, name, notes);
}

std::string report_of(const Export& exported, const Model& model) {
  nlohmann::ordered_json report;
  report["identity"] = fmt::format("{:08x}", identity_of(exported.policy));
  report["model_identity"] = model_identity(model.parameters);
  report["configuration_hash"] = fmt::format("{:08x}", exported.policy.configuration_hash);
  report["weights"] = name_of(exported.policy.network.weights);
  report["calibration_states"] = exported.calibration_states;
  report["input_exponent"] = exported.quantised.input_exponent;
  for (std::size_t l = 0; l < exported.quantised.layers.size(); ++l) {
    const LayerReport& layer = exported.quantised.layers[l];
    report["layers"].push_back({{"weight_exponent", layer.weight_exponent},
                                {"activation_exponent", layer.activation_exponent},
                                {"shift", exported.policy.network.layers[l].shift},
                                {"range_used", layer.range_used},
                                {"headroom_bits", layer.headroom_bits},
                                {"mean_error", layer.mean_error},
                                {"greatest_error", layer.greatest_error}});
  }
  report["validation_states"] = exported.agreement.states;
  report["agreement"] = number_or_null(exported.agreement.agreement);
  report["clear_states"] = exported.agreement.clear_states;
  report["clear_agreement"] = number_or_null(exported.agreement.clear_agreement);
  report["mean_regret"] = number_or_null(exported.agreement.mean_regret);
  report["reward"] = {{"episodes", exported.reward.episodes},
                      {"float_mean", exported.reward.float_mean},
                      {"integer_mean", exported.reward.integer_mean},
                      {"standard_error", exported.reward.standard_error}};
  host::stamp(report);
  return report.dump(2) + "\n";
}

}  // namespace striker::training
