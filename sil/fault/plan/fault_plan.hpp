// SPDX-License-Identifier: Apache-2.0
// A plan of faults: cases, each a list of faults and the run that they happen in. A value: the same plan is the
// same run, byte for byte, in process.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sil/fault/plan/fault_kinds.hpp"
#include "sil/robot/plant.hpp"

namespace striker::sil {

enum class FaultyWheel : std::uint8_t { both, left, right };

inline constexpr std::array<std::string_view, 3> faulty_wheel_names = {"both", "left", "right"};

// What its kind does not ask for is left alone.
struct Fault {
  FaultKind kind = FaultKind::loss;
  std::int32_t from_ms = 0;  // after the first decision of the faulty episode
  std::int32_t until_ms = 0;
  bool absolute = false;                      // both are ticks of the run instead
  std::optional<std::uint16_t> message = {};  // an identifier; nothing: all
  std::uint16_t as = 0;                       // masquerade: the identifier that it comes under
  FaultyWheel wheel = FaultyWheel::both;
  double probability = 1.0;
  std::uint32_t count = 1;
  double value = 0.0;
  std::uint64_t stream = 0;  // of its random draws, beside the case's seed

  bool operator==(const Fault&) const = default;
};

// Nothing where the command line decides.
struct FaultSetup {
  std::optional<PlantKind> plant = {};
  std::optional<bool> anywhere = {};          // the pose
  std::optional<std::uint64_t> seed = {};     // of episodes and faults
  std::optional<std::uint64_t> episode = {};  // this one only
  double torque_scale = 1.0;                  // what the motors give of what they are told to, 0.5 to 1.5

  bool operator==(const FaultSetup&) const = default;
};

struct FaultCase {
  std::string name;
  FaultSetup setup;
  std::vector<Fault> faults;
};

struct FaultPlan {
  std::vector<FaultCase> cases;
};

// A fault with its window in ticks of the run.
struct TimedFault {
  Fault fault;
  std::uint32_t from = 0;
  std::uint32_t until = 0;

  [[nodiscard]] bool lasts(std::uint32_t tick) const { return tick >= from && tick < until; }
};

// Of the run whose faulty episode makes its first decision in this tick. A window that would begin before the run
// begins with it.
[[nodiscard]] std::vector<TimedFault> timed(const std::vector<Fault>& faults,
                                            std::uint32_t first_decision_tick);

// A fault of this kind with the table's values, from the first decision on.
[[nodiscard]] Fault usual(FaultKind kind, std::int32_t from_ms, std::int32_t until_ms);

// On a bus in process, or of SocketCAN. There a simulator in lockstep waits for a second for each answer: what hits
// Sync or EndOfTick is for a bus in process.
[[nodiscard]] bool possible(const Fault& fault, bool in_process);

// The name of the message with this identifier, and back.
[[nodiscard]] std::string message_name(std::uint16_t identifier);
[[nodiscard]] std::optional<std::uint16_t> identifier_of(std::string_view message);

// In words, as "replay WheelState, loss of Sync": for tables.
[[nodiscard]] std::string in_words(const std::vector<Fault>& faults);

}  // namespace striker::sil
