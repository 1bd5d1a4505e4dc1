// SPDX-License-Identifier: Apache-2.0
// The operator of one controller: gives mode commands, confirms what the controller asks back, and hears what it
// says of itself. Nobody but a person presses an emergency stop, or clears it: this operator does neither by itself.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "firmware/can/codec.hpp"
#include "firmware/core/state.hpp"

namespace striker::sil {

class Operator {
 public:
  // A disarm or a renewal acts at once. Arming and clearing are requests: `confirmation` follows.
  [[nodiscard]] can::Frame order(can::Mode mode);
  void hear(std::span<const can::Frame> frames);

  // What a person's button sends; it acts whatever its counter.
  [[nodiscard]] static can::Frame emergency_stop() {
    can::SendCounter counter;
    return can::send(can::EmergencyStop{}, counter);
  }

  // The answer to the controller's challenge, once, if it was for what this operator had asked for.
  [[nodiscard]] std::optional<can::Frame> confirmation();

  // Whether the controller has said anything yet, how often it has told its status, and how often it has decided.
  [[nodiscard]] bool has_heard() const { return has_heard_; }
  [[nodiscard]] std::uint64_t statuses() const { return statuses_; }
  [[nodiscard]] std::uint64_t decisions() const { return decisions_; }

  // By its last status and safety report.
  [[nodiscard]] core::State controller_state() const { return state_; }
  // It has believed an order of a team since it booted: armed, it stands until it is ordered.
  [[nodiscard]] bool has_team() const { return has_team_; }
  [[nodiscard]] core::Fault controller_fault() const { return fault_; }
  [[nodiscard]] bool controller_is_stopped() const;
  // The policy's identity from the last version frame, 8 hexadecimal digits; "unknown" before one came.
  [[nodiscard]] const std::string& policy() const { return policy_; }

 private:
  [[nodiscard]] can::Frame command(can::Mode mode, std::int32_t challenge);
  void take(const can::Challenge& challenge);

  can::SendCounter mode_counter_;
  bool has_heard_ = false;
  std::uint64_t statuses_ = 0;
  std::uint64_t decisions_ = 0;
  std::optional<can::Mode> asked_;
  std::int32_t challenge_ = 0;  // to be confirmed; 0: none
  core::State state_ = core::State::boot;
  bool has_team_ = false;
  core::Fault fault_ = core::Fault::none;
  core::Faults faults_ = 0;
  std::string policy_ = "unknown";
};

}  // namespace striker::sil
