// SPDX-License-Identifier: Apache-2.0
#include "training/export/export_report.hpp"
#include "firmware/host/version.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace striker::training {

namespace {

std::string noted(const Model& model, const std::string& key) {
  const auto found = model.metadata.find(key);
  return found == model.metadata.end() ? "unknown" : found->second;
}

}  // namespace

std::string header_of(const Export& exported, const Model& model, const std::string& name) {
  std::vector<std::string> notes{
      "The kick policy: an integer Q network, written by striker-export. Do not edit: an altered number does",
      "not compile. Format and arithmetic: firmware/policy/policy.hpp.",
      "",
      fmt::format(
          "Trained by striker-train, configuration \"{}\", seed {}; the float model's identity is {}.",
          noted(model, "configuration_name"), noted(model, "seed"), model_identity(model.parameters)),
      fmt::format("Mean reward of the float network on its validation episodes, servo plant: {}.",
                  noted(model, "mean_reward")),
      "",
      fmt::format("Inputs are stored times 2^{}.", exported.quantised.input_exponent)};
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
  report["agreement"] = exported.agreement.agreement;
  report["clear_states"] = exported.agreement.clear_states;
  report["clear_agreement"] = exported.agreement.clear_agreement;
  report["mean_regret"] = exported.agreement.mean_regret;
  report["reward"] = {{"episodes", exported.reward.episodes},
                      {"float_mean", exported.reward.float_mean},
                      {"integer_mean", exported.reward.integer_mean},
                      {"standard_error", exported.reward.standard_error}};
  host::stamp(report);
  return report.dump(2) + "\n";
}

}  // namespace striker::training
