// SPDX-License-Identifier: Apache-2.0
#include "training/export/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

#include "training/export/calibration_play.hpp"
#include "training/export/firmware_limits.hpp"
#include "training/export/names/taken_names.hpp"
#include "training/model/hash.hpp"

namespace striker::training {

namespace {

constexpr int calibration_plays = export_calibration_episodes / 2;
constexpr int validation_plays = export_calibration_episodes - calibration_plays;
constexpr int reward_episodes = export_episodes - export_calibration_episodes;

Agreement compare(const Parameters& parameters, const StateInputs& inputs, const IntegerNetwork& network,
                  const std::vector<RawState>& states) {
  std::vector<TakenDecision> decisions;
  decisions.reserve(states.size());
  for (const RawState& state : states) {
    decisions.push_back({.state = state, .action = static_cast<int>(evaluate(network, state).action)});
  }
  return agreement(parameters, inputs, decisions);
}

// What every export of a model is quantised by.
std::vector<RawState> calibration_of(const Model& model, const TaskConfig& task,
                                     const EpisodePlayed& played) {
  require_firmware_serves(task);
  require_header_compiles(model.parameters.shape());
  return calibration_play(model.parameters, task, 0, calibration_plays, played);
}

// Neither C++'s own, nor the firmware's, nor a macro of the compilers.
bool is_free_name(std::string_view name) {
  return name.find("__") == std::string_view::npos &&
         std::ranges::find(taken_names, name) == taken_names.end();
}

}  // namespace

Export export_model(const Model& model, const TaskConfig& task, WeightType weights,
                    const EpisodePlayed& played) {
  const Parameters& parameters = model.parameters;
  const std::vector<RawState> calibration = calibration_of(model, task, played);
  const std::vector<RawState> validation =
      calibration_play(parameters, task, calibration_plays, validation_plays, played);
  Export exported;
  exported.calibration_states = calibration.size();
  exported.quantised = quantise(parameters, task.inputs, calibration, weights);
  exported.agreement = compare(parameters, task.inputs, exported.quantised.network, validation);
  exported.reward = reward_difference(parameters, exported.quantised.network, task, reward_episodes, played);

  ExportedPolicy& policy = exported.policy;
  const auto configuration = model.metadata.find("configuration");
  policy.configuration_hash = fnv1a(configuration == model.metadata.end() ? "" : configuration->second);
  policy.decision_period_ms = sil::decision_period_ms;
  policy.inputs = task.inputs;
  policy.one_sided = task.one_sided;
  policy.network = exported.quantised.network;
  policy.actions = task.actions;
  policy.golden_vectors = golden_vectors(policy.network, task.inputs, validation);
  return exported;
}

IntegerNetwork integers_of(const Model& model, const TaskConfig& task, WeightType weights) {
  const std::vector<RawState> calibration = calibration_of(model, task, [] {});
  return quantise(model.parameters, task.inputs, calibration, weights).network;
}

std::string policy_name_of(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  const bool begins = !name.empty() && (std::islower(static_cast<unsigned char>(name.front())) != 0);
  const bool goes_on = std::all_of(name.begin(), name.end(), [](unsigned char letter) {
    return std::islower(letter) != 0 || std::isdigit(letter) != 0 || letter == '_';
  });
  if (!begins || !goes_on) {
    throw std::runtime_error(
        fmt::format("{}: '{}' cannot be the policy's name in C++: use a-z, 0-9 and _, or give one as --name",
                    file.string(), name));
  }
  if (!is_free_name(name)) {
    throw std::runtime_error(fmt::format(
        "{}: '{}' cannot be the policy's name in C++, where it means something else already: give "
        "another one as --name, or name the file otherwise",
        file.string(), name));
  }
  return name;
}

}  // namespace striker::training
