// SPDX-License-Identifier: Apache-2.0
// One case of faults in one kick: the episode without the faults, with them, and if asked the next one, to see
// whether the controller comes back.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sil/fault/plan/fault_plan.hpp"
#include "sil/fault/watch/invariants.hpp"

namespace striker::sil {

struct FaultRunOptions {
  PlantKind plant = PlantKind::drive;
  bool anywhere = false;
  std::uint64_t seed = 1;
  std::uint64_t episode = 0;
  std::string interface;      // of SocketCAN; empty: the controller in this process
  bool sees_recovery = true;  // plays the next episode too
  bool sees_undisturbed = true;
};

enum class FaultOutcome : std::uint8_t {
  rides_through,  // armed to the end of the episode
  stops,          // not armed at its end, nor in the next
  recovers,       // not armed at its end, and drives in the next
  not_armed,      // was not armed when the fault began
};

inline constexpr std::array<std::string_view, 4> fault_outcome_names = {"rides through", "stops", "recovers",
                                                                        "not armed"};

// A value that travels as one line of JSON.
struct FaultResult {
  std::string detected_by;  // the controller's fault, "drives' time-out", "limit" of the gate, or empty
  std::optional<std::uint32_t> detected_ms;
  std::optional<std::uint32_t> zero_torque_ms;
  FaultOutcome outcome = FaultOutcome::rides_through;
  double reward = 0.0;
  double undisturbed_reward = 0.0;
  std::vector<Violation> violations;
  std::string failure;  // the run itself: it crashed, or could not be played
};

// What the case's own setup says goes before the options. A pure function of both, in process. Throws
// std::runtime_error where the case cannot be played.
[[nodiscard]] FaultResult play_fault(const FaultCase& faults, const FaultRunOptions& options);

[[nodiscard]] std::string to_line(const FaultResult& result);
[[nodiscard]] FaultResult result_from_line(const std::string& line);  // throws if it is none

}  // namespace striker::sil
