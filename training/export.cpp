#include "export.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "hash.hpp"
#include "world/random.hpp"

namespace striker::training {

namespace {

constexpr std::uint64_t calibration_seed = 1;
constexpr std::uint64_t calibration_stream = 104;
constexpr int calibration_plays = 150;
constexpr int validation_plays = 150;
constexpr std::size_t golden_count = 16;

// The states before contact of `count` episodes each of greedy and of random play, beginning with `first`.
std::vector<RawState> met_states(const Parameters& parameters, int first, int count) {
  std::vector<RawState> states;
  KickEnv env({.world = World::full});
  const auto collect = [&](const RcsState& state) {
    if (!env.outcome().contact) {
      states.push_back(raw_state(state));
    }
  };
  for (int i = first; i < first + count; ++i) {
    const std::uint64_t episode = calibration_episodes + static_cast<std::uint64_t>(i);
    const sil::KickStart start = sil::draw_kick(calibration_seed, episode, sil::PoseMode::origin);
    play(env, start, [&](const RcsState& state) {
      collect(state);
      return greedy_action(q_values(parameters, features(state)));
    });
    sil::Random random(calibration_seed, episode, calibration_stream);
    play(env, start, [&](const RcsState& state) {
      collect(state);
      return static_cast<int>(random.below(actions));
    });
  }
  return states;
}

// Every input saturates: all up, all down, and in turn.
std::vector<RawState> extreme_states() {
  constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t greatest = std::numeric_limits<std::int32_t>::max();
  constexpr std::int32_t least_angle = -32768;
  constexpr std::int32_t greatest_angle = 32767;
  return {{greatest, greatest, greatest, greatest, greatest, greatest_angle},
          {least, least, least, least, least, least_angle},
          {greatest, least, greatest, least, greatest, least_angle},
          {least, greatest, least, greatest, least, greatest_angle}};
}

std::vector<GoldenVector> golden_vectors(const IntegerNetwork& network, const std::vector<RawState>& met) {
  std::vector<RawState> states = extreme_states();
  const std::size_t from_play = golden_count - states.size();
  for (std::size_t i = 0; i < from_play; ++i) {
    states.push_back(met[i * met.size() / from_play]);
  }
  std::vector<GoldenVector> goldens;
  goldens.reserve(states.size());
  for (const RawState& state : states) {
    goldens.push_back({.raw = {state.begin(), state.end()}, .answer = evaluate(network, state)});
  }
  return goldens;
}

Agreement compare(const Parameters& parameters, const IntegerNetwork& network,
                  const std::vector<RawState>& states) {
  std::vector<Decision> decisions;
  decisions.reserve(states.size());
  for (const RawState& state : states) {
    decisions.push_back({.state = state, .action = static_cast<int>(evaluate(network, state).action)});
  }
  return agreement(parameters, decisions);
}

std::string noted(const Model& model, const std::string& key) {
  const auto found = model.metadata.find(key);
  return found == model.metadata.end() ? "unknown" : found->second;
}

}  // namespace

Export export_model(const Model& model) {
  if (equations_of(model) == Equations::printed) {
    throw std::runtime_error(
        "the model was trained with the paper's printed equations, which the firmware does "
        "not compute; train with equations = \"corrected\"");
  }
  const std::vector<RawState> calibration = met_states(model.parameters, 0, calibration_plays);
  const std::vector<RawState> validation = met_states(model.parameters, calibration_plays, validation_plays);
  Export exported;
  exported.calibration_states = calibration.size();
  exported.quantised = quantise(model.parameters, calibration);
  exported.agreement = compare(model.parameters, exported.quantised.network, validation);

  ExportedPolicy& policy = exported.policy;
  const auto configuration = model.metadata.find("configuration");
  policy.configuration_hash = fnv1a(configuration == model.metadata.end() ? "" : configuration->second);
  policy.decision_period_ms = static_cast<std::int32_t>(std::lround(sil::decision_period_s * 1e3));
  policy.network = exported.quantised.network;
  for (const double speed_m_s : set_points_m_s) {
    const auto speed_mm_s = static_cast<std::int32_t>(std::lround(speed_m_s * 1e3));
    policy.set_points.push_back({.left_mm_s = speed_mm_s, .right_mm_s = speed_mm_s});
  }
  policy.golden_vectors = golden_vectors(policy.network, validation);
  return exported;
}

std::string header_of(const Export& exported, const Model& model) {
  std::vector<std::string> notes{
      "The kick policy: an integer Q network, written by striker-export. Do not edit: an altered number does",
      "not compile. Format and arithmetic: core/policy.hpp.",
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
  return header_text(exported.policy, notes);
}

std::string report_of(const Export& exported, const Model& model) {
  nlohmann::ordered_json report;
  report["identity"] = fmt::format("{:08x}", identity_of(exported.policy));
  report["model_identity"] = model_identity(model.parameters);
  report["configuration_hash"] = fmt::format("{:08x}", exported.policy.configuration_hash);
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
  return report.dump(2) + "\n";
}

}  // namespace striker::training
