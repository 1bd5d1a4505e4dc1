// SPDX-License-Identifier: Apache-2.0
// One robot of a match on its own bus: its seat, its operator, and the team's voice on the bus. What it is told in a
// frame of 50 ms goes out in that frame's first tick; a robot that was just armed is told its last order again, so
// that it never plays by itself.
//
//   at a frame's begin     is_wanted(), was_placed(), sees(), is_told()
//   once a tick            begin_tick(), end_tick(), and where the world steps actuate(), sense()
//   at a frame's end       take_record()
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "firmware/core/robot_profile.hpp"
#include "sil/bus/controller_link.hpp"
#include "sil/fault/faulty_seat.hpp"
#include "sil/match/play/order_sender.hpp"
#include "sil/match/play/robot_operator.hpp"
#include "sil/match/record/match_frame.hpp"
#include "sil/robot/camera.hpp"
#include "sil/robot/plant.hpp"
#include "sil/robot/seat.hpp"
#include "sil/robot/striker_drives.hpp"

namespace striker::sil {

// What goes wrong with one robot (sil/fault); ticks are those of the match.
struct RobotFaults {
  std::vector<TimedFault> faults;
  std::uint64_t seed = 0;
};

class MatchRobot {
 public:
  // `link` outlives it. Throws std::runtime_error that names a fault which this robot's controller cannot have: a robot
  // without a policy has no faults of its controller's memory, process or SYNC.
  MatchRobot(std::size_t robot, const core::RobotDescription& description, std::unique_ptr<Plant> plant,
             ControllerLink& link, const RobotFaults& faults = {});
  MatchRobot(const MatchRobot&) = delete;
  MatchRobot& operator=(const MatchRobot&) = delete;

  void is_wanted(bool armed) { operator_.wants(armed); }
  void was_placed();
  void sees(const World& world, std::uint32_t tick);
  // In the field frame.
  void is_told(const RobotOrder& order, std::uint32_t tick);

  // With the next tick's frames.
  void queue(const can::Frame& frame) { seat_->queue(frame); }

  void begin_tick(std::uint32_t tick);
  void end_tick(std::uint32_t tick);
  void actuate(World& world, std::uint32_t tick) { seat_->actuate(world, tick); }
  void sense(const World& world) { seat_->sense(world); }

  // Since the last one.
  [[nodiscard]] RobotRecord take_record(const World& world, std::uint32_t tick);
  // On its bus in this tick.
  [[nodiscard]] std::span<const StampedFrame> traffic() const { return seat_->traffic(); }
  [[nodiscard]] std::uint32_t ticks_per_step() const { return seat_->ticks_per_step(); }
  [[nodiscard]] const Operator& heard() const { return operator_.heard(); }

 private:
  void say(const RobotOrder& order, std::uint32_t tick);

  double torque_limit_Nm_;
  std::unique_ptr<Plant> plant_;
  StrikerDrives drives_;
  ExactCamera camera_;
  std::optional<Seat> sound_seat_;
  std::unique_ptr<FaultySeat> faulty_seat_;  // instead, where something goes wrong
  Seat* seat_;
  RobotOperator operator_;
  OrderSender team_;
  std::optional<RobotOrder> last_order_;
  std::optional<std::uint32_t> last_order_tick_;
  std::uint32_t status_tick_ = 0;
  int saturated_ticks_ = 0;
  int lost_frames_ = 0;
};

}  // namespace striker::sil
