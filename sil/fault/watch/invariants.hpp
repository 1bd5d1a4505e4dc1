// SPDX-License-Identifier: Apache-2.0
// What must hold in every tick of every run, whatever goes wrong. Stated from outside: from the frames at both ends
// of the faulty bus, and from the true world. Nothing here asks the controller's own code.
//
// Honest is what the seat itself put on the bus: a frame that reaches the controller counts as of the tick in which
// the seat last sent those very bytes. So a lost, held, repeated, damaged or forged frame is as old as it is, and no
// fault has to tell what it did.
//
//   unarmed_torque   a command with torque, while the controller's last status is neither active nor a fault
//   fault_torque     a command with torque, more than two commands after a status with a fault
//   limits           torque or set-point beyond the robot's own
//   stop_ignored     torque more than two ticks after an emergency stop has reached the controller
//   stale_wheels     torque, and the last honest wheel state is older than 25 ms
//   stale_vision     torque, and the last honest pose or ball is older than 200 ms
//   stale_sync       torque, and the last SYNC whose tick went on is older than 25 ms
//   stale_command    the drives hold a torque whose honest command is older than their time-out, 10 ms
//   fault_changed    the first fault became another, or none, without an honest clear; state_corrupt alone may take
//                    the place of what the corrupt memory held
//   unasked_arming   active, and no operator has asked for it since the last time, or the last disarm
//   unknown_value    a frame of the controller that its own table refuses
//   runaway          a rim at 2.5 times the robot's greatest speed. Full torque for 200 ms, the oldest picture that may
//                    be driven on, adds 2.2 m/s to 2.55 straight on (11.1 m/s^2), 2.9 turning on the spot (a box of
//                    1.5 kg and 0.15 m on an axle of 0.14 m: 14.7 m/s^2), and 3.8 with motors 30 % too strong
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/can/codec.hpp"
#include "firmware/core/robot_profile.hpp"
#include "sil/fault/link/link_faults.hpp"
#include "sil/record/observer.hpp"
#include "sil/robot/plant.hpp"
#include "sil/robot/wheel_drives.hpp"

namespace striker::sil {

enum class Invariant : std::uint8_t {
  unarmed_torque,
  fault_torque,
  limits,
  stop_ignored,
  stale_wheels,
  stale_vision,
  stale_sync,
  stale_command,
  fault_changed,
  unasked_arming,
  unknown_value,
  runaway,
};

inline constexpr std::array<std::string_view, 12> invariant_names = {
    "unarmed_torque", "fault_torque",  "limits",        "stop_ignored",   "stale_wheels",  "stale_vision",
    "stale_sync",     "stale_command", "fault_changed", "unasked_arming", "unknown_value", "runaway"};

[[nodiscard]] constexpr std::string_view name_of(Invariant invariant) {
  return invariant_names[static_cast<std::size_t>(invariant)];
}

struct Violation {
  std::uint32_t tick = 0;
  Invariant invariant = Invariant::unarmed_torque;
  std::string text;  // figures, for a reader
};

// All of them outlive the observer.
struct WatchedParts {
  const LinkTap& at_seat;        // what the seat sends and gets
  const LinkTap& at_controller;  // what the controller gets and says
  const WheelDrives& drives;     // without their faults
  const Plant& plant;            // without its faults
};

// What no check of a frame can find, so that it is not asserted.
struct OutOfReach {
  // A recording of at least as many frames of a message as its receiver asks for, played again and again, is the
  // sender itself to any check but authentication (firmware/can/e2e_state.hpp): what it makes stale stays so until
  // something else notices.
  std::vector<Invariant> invariants = {};
  // What was late on the way, in order, does not show it: every age may be greater by this.
  std::uint32_t lateness_ticks = 0;
};

[[nodiscard]] OutOfReach out_of_reach_of(const std::vector<TimedFault>& faults);

class Invariants final : public Observer {
 public:
  // In the ticks of `reboots` the controller boots anew, and what it told before is void.
  Invariants(const WatchedParts& parts, const core::RobotProfile& robot,
             std::vector<std::uint32_t> reboots = {}, OutOfReach out_of_reach = {});

  void end_tick(const Snapshot& snapshot) override;

  // The first of each invariant, in the order of their ticks; and how many ticks broke one.
  [[nodiscard]] const std::vector<Violation>& violations() const { return violations_; }
  [[nodiscard]] std::uint64_t ticks_violated() const { return ticks_violated_; }

 private:
  // The frames of one message that were sent honestly, and the newest of them that has arrived.
  struct HonestFrames {
    std::uint16_t identifier = 0;
    std::deque<std::pair<can::Frame, std::uint32_t>> sent;
    std::optional<std::uint32_t> arrived;

    void send(const can::Frame& frame, std::uint32_t tick);
    void arrive(const can::Frame& frame);
    [[nodiscard]] bool older_than(std::uint32_t ticks, std::uint32_t now) const {
      return !arrived || now - *arrived > ticks;
    }
  };

  void hear_seat();
  void hear_inputs();
  void hear_controller();
  void begin_time_anew();
  void hear_status(const can::Frame& frame);
  void hear_command(const can::WheelCommand& command);
  void check_freshness();
  void check_drives();
  void violate(Invariant invariant, const std::string& text);

  WatchedParts parts_;
  core::RobotProfile robot_;
  std::vector<std::uint32_t> reboots_;
  OutOfReach out_of_reach_;
  std::uint32_t tick_ = 0;
  std::vector<Violation> violations_;
  std::uint64_t ticks_violated_ = 0;
  bool violated_now_ = false;

  HonestFrames wheels_{can::layout<can::WheelState>.info.id, {}, {}};
  HonestFrames pose_{can::layout<can::VisionPose>.info.id, {}, {}};
  HonestFrames ball_{can::layout<can::VisionBall>.info.id, {}, {}};
  HonestFrames commands_{can::layout<can::WheelCommand>.info.id, {}, {}};
  std::optional<std::uint32_t> sync_tick_;  // when SYNC's tick went on
  std::uint32_t told_tick_ = 0;             // by the last SYNC
  std::optional<std::uint32_t>
      stop_tick_;             // an emergency stop reached the controller, and was not cleared since
  bool arm_asked_ = false;    // since it was last active, or disarmed
  bool clear_asked_ = false;  // since the fault was told

  bool time_began_anew_ = false;  // by a SYNC(0) of this tick
  std::optional<can::Status> told_;
  std::uint32_t commands_since_fault_ = 0;
  can::WheelCommand command_;  // the last one of the tick
};

}  // namespace striker::sil
