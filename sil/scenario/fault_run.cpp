// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/fault_run.hpp"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "firmware/loop/built_in_node.hpp"
#include "sil/bus/in_process_link.hpp"
#include "sil/bus/socketcan_link.hpp"
#include "sil/fault/faulty_seat.hpp"
#include "sil/fault/watch/timeline.hpp"
#include "sil/robot/striker_drives.hpp"
#include "sil/robot/variation.hpp"
#include "sil/scenario/kick_scenario.hpp"

namespace striker::sil {

namespace {

// Of the faulty episode, the first of its run.
constexpr std::uint32_t first_decision_tick = kick_boot_ticks + kick_first_decision_tick;
constexpr std::uint32_t last_tick = kick_boot_ticks + kick_last_tick;

FaultRunOptions with_setup(FaultRunOptions options, const FaultSetup& setup) {
  options.plant = setup.plant.value_or(options.plant);
  options.anywhere = setup.anywhere.value_or(options.anywhere);
  options.seed = setup.seed.value_or(options.seed);
  options.episode = setup.episode.value_or(options.episode);
  return options;
}

std::uint32_t begin_of(const std::vector<TimedFault>& faults, std::uint32_t otherwise) {
  std::uint32_t from = faults.empty() ? otherwise : faults.front().from;
  for (const TimedFault& fault : faults) {
    from = std::min(from, fault.from);
  }
  return from;
}

struct Play {
  FaultResult result;
  std::vector<KickOutcome> outcomes;
};

FaultOutcome outcome_of(const FaultTimeline& timeline) {
  if (!timeline.armed_before()) {
    return FaultOutcome::not_armed;
  }
  if (timeline.armed_at_end()) {
    return FaultOutcome::rides_through;
  }
  return timeline.drove_later() ? FaultOutcome::recovers : FaultOutcome::stops;
}

void tell(const FaultTimeline& timeline, FaultResult& result) {
  const char* const otherwise = timeline.limited() ? "limit" : "";
  result.detected_by = timeline.fault().value_or(timeline.drives_cut() ? "drives' time-out" : otherwise);
  result.detected_ms = timeline.detected_ms();
  result.zero_torque_ms = timeline.zero_torque_ms();
  result.outcome = outcome_of(timeline);
}

Play play(const std::vector<TimedFault>& faults, double torque_scale, const FaultRunOptions& options,
          std::uint64_t episodes) {
  std::unique_ptr<InProcessLink> in_process;
  std::unique_ptr<ControllerLink> socket;
  if (options.interface.empty()) {
    in_process = std::make_unique<InProcessLink>();
  } else {
    socket = std::make_unique<LockstepLink>(options.interface, SocketCanOptions{});
  }
  const RobotSpec robot = spec_of(loop::built_in_description);
  const Variation as_described = completed({}, loop::built_in_description);
  const auto plants = make_plants(options.plant, robot, as_described);
  StrikerDrives drives;
  ExactCamera camera(0);
  FaultySeat seat({.robot = 0,
                   .plant = *plants.back(),
                   .drives = drives,
                   .camera = camera,
                   .link = in_process ? static_cast<ControllerLink&>(*in_process) : *socket,
                   .controller = in_process.get(),
                   .interface = options.interface},
                  faults, options.seed, torque_scale);
  Invariants invariants(seat.watched(), loop::built_in_robot, seat.reboots(), out_of_reach_of(faults));
  FaultTimeline timeline(seat.watched(), begin_of(faults, last_tick), last_tick);
  const std::array<Observer*, 3> observers = {&seat.clock(), &invariants, &timeline};
  KickScenario scenario({.pose = options.anywhere ? PoseMode::anywhere : PoseMode::origin,
                         .seed = options.seed,
                         .first_episode = options.episode,
                         .episodes = episodes,
                         .place = {.robot = robot},
                         .vision_latency_ticks = as_described.vision_latency_ms.value(),
                         .camera_rate_Hz = as_described.camera_rate_Hz.value(),
                         .pictures_a_motion = core::pictures_a_motion(loop::built_in_robot)},
                        seat.seat(), observers);
  scenario.run([] { return false; });
  Play played{.result = {}, .outcomes = scenario.outcomes()};
  tell(timeline, played.result);
  played.result.violations = invariants.violations();
  return played;
}

double first_reward(const Play& played) {
  return played.outcomes.empty() ? 0.0 : played.outcomes.front().reward;
}

Invariant invariant_of(const std::string& name) {
  const auto* const found = std::find(invariant_names.begin(), invariant_names.end(), name);
  if (found == invariant_names.end()) {
    throw std::runtime_error("no invariant is called " + name);
  }
  return static_cast<Invariant>(found - invariant_names.begin());
}

nlohmann::ordered_json optional_json(const std::optional<std::uint32_t>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

std::optional<std::uint32_t> optional_from(const nlohmann::json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<std::uint32_t>());
}

}  // namespace

FaultResult play_fault(const FaultCase& faults, const FaultRunOptions& given) {
  const FaultRunOptions options = with_setup(given, faults.setup);
  const auto in_time = timed(faults.faults, first_decision_tick);
  const Play played = play(in_time, faults.setup.torque_scale, options, options.sees_recovery ? 2 : 1);
  FaultResult result = played.result;
  result.reward = first_reward(played);
  if (options.sees_undisturbed) {
    result.undisturbed_reward = first_reward(play({}, faults.setup.torque_scale, options, 1));
  }
  return result;
}

std::string to_line(const FaultResult& result) {
  nlohmann::ordered_json violations = nlohmann::ordered_json::array();
  for (const Violation& one : result.violations) {
    violations.push_back({{"tick", one.tick}, {"invariant", name_of(one.invariant)}, {"text", one.text}});
  }
  const nlohmann::ordered_json line = {
      {"detected_by", result.detected_by},
      {"detected_ms", optional_json(result.detected_ms)},
      {"zero_torque_ms", optional_json(result.zero_torque_ms)},
      {"outcome", fault_outcome_names[static_cast<std::size_t>(result.outcome)]},
      {"reward", result.reward},
      {"undisturbed_reward", result.undisturbed_reward},
      {"violations", violations},
      {"failure", result.failure}};
  return line.dump();
}

FaultResult result_from_line(const std::string& line) {
  const auto json = nlohmann::json::parse(line);
  FaultResult result;
  result.detected_by = json.at("detected_by");
  result.detected_ms = optional_from(json.at("detected_ms"));
  result.zero_torque_ms = optional_from(json.at("zero_torque_ms"));
  const auto* const outcome = std::find(fault_outcome_names.begin(), fault_outcome_names.end(),
                                        json.at("outcome").get<std::string>());
  if (outcome == fault_outcome_names.end()) {
    throw std::runtime_error("an outcome without a name");
  }
  result.outcome = static_cast<FaultOutcome>(outcome - fault_outcome_names.begin());
  result.reward = json.at("reward");
  result.undisturbed_reward = json.at("undisturbed_reward");
  for (const auto& one : json.at("violations")) {
    result.violations.push_back(
        {.tick = one.at("tick"), .invariant = invariant_of(one.at("invariant")), .text = one.at("text")});
  }
  result.failure = json.at("failure");
  return result;
}

}  // namespace striker::sil
