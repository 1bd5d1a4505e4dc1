// SPDX-License-Identifier: Apache-2.0
// What can go wrong: the one table of all kinds of faults. The plan's reader and writer, the campaign's draws
// and the README's table follow from it.
//
// Every kind lasts from a tick to a tick. What it needs to know beyond that is a parameter; each has a range, and
// a value of its own where a plan does not give it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace striker::sil {

// Frames in the order in which they pass the faults on their way to the controller, then everything else.
enum class FaultKind : std::uint8_t {
  sync_repeat,
  sync_freeze,
  sync_backward,
  sync_wrap,
  sync_restart,
  second_simulator,
  loss,
  picture_loss,
  replay,
  masquerade,
  duplicate,
  flip_bits,
  wrong_length,
  delay,
  jitter,
  reorder,
  babble,
  emergency_stop,
  remote_frames,
  extended_frames,
  fd_frames,
  stall,
  bus_off,
  error_passive,
  interface_down,
  state_flips,
  weight_flips,
  second_controller,
  brown_out,
  camera_frozen,
  camera_late,
  camera_jump,
  camera_turn,
  camera_noise,
  camera_bias,
  camera_mirrored,
  ball_jumps,
  wheels_frozen,
  wheels_reversed,
  wheels_swapped,
  wheels_scaled,
  wheels_wrapped,
  wheels_jump,
  torque_cut_told,
  wheel_stuck,
  wheel_slips,
  torque_saturated,
};

// Where it sits: which part of a seat it stands before.
enum class FaultPlace : std::uint8_t { frames, node, camera, drives, plant };

struct ParameterRange {
  double least = 0.0;
  double greatest = -1.0;  // less than `least`: the kind has no such parameter
  double otherwise = 0.0;  // where a plan gives none

  [[nodiscard]] constexpr bool known() const { return least <= greatest; }
};

enum class MessageParameter : std::uint8_t {
  none,
  any,  // one message, or "all" but those of lockstep, Sync and EndOfTick
  one,  // one message
};

struct FaultKindInfo {
  FaultKind kind;
  std::string_view name;
  FaultPlace place;
  std::string_view does;
  bool in_process = false;  // it needs the controller in the simulator's process
  bool real_bus = false;    // it needs a bus of SocketCAN: in process such frames do not exist
  bool at_once = false;     // it happens in the first tick of its window
  MessageParameter message = MessageParameter::none;
  bool wheel = false;
  ParameterRange probability = {};  // of each frame or picture
  ParameterRange count = {};        // a whole number
  ParameterRange value = {};
  std::string_view value_key = {};  // the value's key in a plan, with its unit
};

[[nodiscard]] std::span<const FaultKindInfo> fault_kinds();  // in the order of FaultKind
[[nodiscard]] const FaultKindInfo& info_of(FaultKind kind);
[[nodiscard]] std::optional<FaultKind> fault_kind_of(std::string_view name);

}  // namespace striker::sil
