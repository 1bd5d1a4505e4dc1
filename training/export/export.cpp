#include "training/export/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sil/world/random.hpp"
#include "training/model/hash.hpp"

namespace striker::training {

namespace {

constexpr std::uint64_t calibration_seed = 1;
constexpr std::uint64_t calibration_stream = 104;
constexpr int calibration_plays = 150;
constexpr int validation_plays = 150;
constexpr std::size_t golden_count = 16;
constexpr int reward_episodes = 500;
constexpr std::size_t greatest_firmware_inputs = 32;  // core::greatest_inputs

// The states before contact of `count` episodes each of greedy and of random play, beginning with `first`.
std::vector<RawState> met_states(const Parameters& parameters, EnvConfig task, int first, int count) {
  std::vector<RawState> states;
  task.world = World::full;
  KickEnv env(task);
  Actor actor(parameters.shape());
  const auto collect = [&states](const KickEnv& seen) {
    if (!seen.outcome().contact) {
      states.push_back(seen.raw());
    }
  };
  for (int i = first; i < first + count; ++i) {
    const std::uint64_t episode = calibration_episodes + static_cast<std::uint64_t>(i);
    play(env, calibration_seed, episode, [&](const KickEnv& seen) {
      collect(seen);
      return actor.choose(parameters, seen.features());
    });
    sil::Random random(calibration_seed, episode, calibration_stream);
    play(env, calibration_seed, episode, [&](const KickEnv& seen) {
      collect(seen);
      return static_cast<int>(random.below(task.actions.size()));
    });
  }
  return states;
}

// Every input saturates: all up, all down, and in turn. Only some values are possible for an angle.
std::vector<RawState> extreme_states(const StateInputs& inputs) {
  std::vector<RawState> states;
  for (const unsigned pattern : {0b00U, 0b11U, 0b10U, 0b01U}) {
    RawState state;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const bool low = ((pattern >> (i % 2)) & 1U) != 0;
      if (inputs[i].element == Element::ball_angle) {
        state.push_back(low ? std::numeric_limits<std::int16_t>::min()
                            : std::numeric_limits<std::int16_t>::max());
      } else {
        state.push_back(low ? std::numeric_limits<std::int32_t>::min()
                            : std::numeric_limits<std::int32_t>::max());
      }
    }
    states.push_back(state);
  }
  return states;
}

std::vector<GoldenVector> golden_vectors(const IntegerNetwork& network, const StateInputs& inputs,
                                         const std::vector<RawState>& met) {
  std::vector<RawState> states = extreme_states(inputs);
  const std::size_t from_play = golden_count - states.size();
  for (std::size_t i = 0; i < from_play; ++i) {
    states.push_back(met[i * met.size() / from_play]);
  }
  std::vector<GoldenVector> goldens;
  goldens.reserve(states.size());
  for (const RawState& state : states) {
    goldens.push_back({.raw = state, .answer = evaluate(network, state)});
  }
  return goldens;
}

Agreement compare(const Parameters& parameters, const StateInputs& inputs, const IntegerNetwork& network,
                  const std::vector<RawState>& states) {
  std::vector<Decision> decisions;
  decisions.reserve(states.size());
  for (const RawState& state : states) {
    decisions.push_back({.state = state, .action = static_cast<int>(evaluate(network, state).action)});
  }
  return agreement(parameters, inputs, decisions);
}

void require_firmware_serves(const EnvConfig& task) {
  if (task.equations == Equations::printed) {
    throw std::runtime_error(
        "the model was trained with the paper's printed equations, which the firmware does "
        "not compute; train with equations = \"corrected\"");
  }
  for (const StateInput& input : task.inputs) {
    if (facts_of(input.element).raw_per_value == 0.0) {
      throw std::runtime_error(fmt::format(
          "the model reads {}, which the controller does not know; train with inputs = \"rcs\" or those that "
          "paper.toml says the controller has",
          facts_of(input.element).name));
    }
  }
  if (task.inputs.size() > greatest_firmware_inputs) {
    throw std::runtime_error(fmt::format("the model reads {} inputs; the controller offers room for {}",
                                         task.inputs.size(), greatest_firmware_inputs));
  }
}

std::int32_t mm_s(double speed_m_s) {
  return static_cast<std::int32_t>(std::lround(speed_m_s * 1e3));
}

std::string noted(const Model& model, const std::string& key) {
  const auto found = model.metadata.find(key);
  return found == model.metadata.end() ? "unknown" : found->second;
}

}  // namespace

Export export_model(const Model& model, const EnvConfig& task, WeightType weights) {
  require_firmware_serves(task);
  const Parameters& parameters = model.parameters;
  const std::vector<RawState> calibration = met_states(parameters, task, 0, calibration_plays);
  const std::vector<RawState> validation = met_states(parameters, task, calibration_plays, validation_plays);
  Export exported;
  exported.calibration_states = calibration.size();
  exported.quantised = quantise(parameters, task.inputs, calibration, weights);
  exported.agreement = compare(parameters, task.inputs, exported.quantised.network, validation);
  exported.reward = reward_difference(parameters, exported.quantised.network, task, reward_episodes);

  ExportedPolicy& policy = exported.policy;
  const auto configuration = model.metadata.find("configuration");
  policy.configuration_hash = fnv1a(configuration == model.metadata.end() ? "" : configuration->second);
  policy.decision_period_ms = static_cast<std::int32_t>(std::lround(sil::decision_period_s * 1e3));
  policy.inputs = task.inputs;
  policy.mirrored = task.mirrored;
  policy.network = exported.quantised.network;
  for (const SetPoints& action : task.actions) {
    policy.set_points.push_back({.left_mm_s = mm_s(action.left_m_s), .right_mm_s = mm_s(action.right_m_s)});
  }
  policy.golden_vectors = golden_vectors(policy.network, task.inputs, validation);
  return exported;
}

std::string policy_name_of(const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  const bool begins = !name.empty() && (std::islower(static_cast<unsigned char>(name.front())) != 0);
  const bool goes_on = std::all_of(name.begin(), name.end(), [](unsigned char letter) {
    return std::islower(letter) != 0 || std::isdigit(letter) != 0 || letter == '_';
  });
  if (!begins || !goes_on) {
    throw std::runtime_error(
        fmt::format("{}: '{}' cannot be the policy's name in C++: use a-z, 0-9 and _, or give one as --name",
                    file.string(), name));
  }
  return name;
}

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
  return report.dump(2) + "\n";
}

}  // namespace striker::training
