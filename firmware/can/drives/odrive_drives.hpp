// SPDX-License-Identifier: Apache-2.0
// Two ODrives, spoken to in CANSimple (ODrive's manual, "CAN Protocol"; firmware 0.6, and 0.5.6 as far as it is used
// here): identifier = node << 5 | command, little-endian, IEEE 754 binary32.
//
//   to each      0x0E Set_Input_Torque       float Nm of the motor; every tick, 0 as well: it feeds the drive's watchdog
//                0x18 Clear_Errors, 0x0B Set_Controller_Mode (torque, passthrough), 0x07 Set_Axis_State (closed loop):
//                                            in this order, a frame a tick, when the controller becomes active;
//                                            the mode again every 45 ms, since no frame tells which one it is in
//                0x07 Set_Axis_State (idle)  when it ends, and whenever a drive tells of closed loop then
//   from each    0x09 Get_Encoder_Estimates  float turns, float turns/s of the motor; every 1 ms
//                0x01 Heartbeat              error, axis state; every 10 ms
//                0x03 Get_Error              if it is sent: an active error counts
//
// Settings of each drive (odrivetool): can.node_id; controller.config.control_mode = 1 and input_mode = 1; axis.config.can.encoder_msg_rate_ms = 1 and heartbeat_msg_rate_ms = 10;
// axis.config.enable_watchdog = True and watchdog_timeout = 0.01: without them the wheel goes on turning when commands stop.
//
// Rounding: a speed is the exact product of the float and the rim's um a turn, to the nearest um/s, then to the nearest
// mm/s; a torque the float nearest to the exact quotient. Read back it is the same whole mNm, for every torque and gear
// (tests/drives/binary32_test.cpp). NaN, infinities and speeds beyond 8 m/s are out_of_range.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/can/drives/binary32.hpp"
#include "firmware/can/drives/drive_pair.hpp"
#include "firmware/can/drives/drive_protocol.hpp"
#include "firmware/can/drives/drive_wiring.hpp"
#include "firmware/can/drives/little_endian.hpp"
#include "firmware/core/robot_profile.hpp"

namespace striker::can {

namespace odrive {

enum Command : std::uint16_t {
  heartbeat = 0x01,
  get_error = 0x03,
  set_axis_state = 0x07,
  get_encoder_estimates = 0x09,
  set_controller_mode = 0x0B,
  set_input_torque = 0x0E,
  clear_errors = 0x18,
};

inline constexpr std::uint32_t idle = 1;
inline constexpr std::uint32_t closed_loop = 8;
inline constexpr std::uint32_t torque_control = 1;  // controller mode
inline constexpr std::uint32_t passthrough = 1;     // input mode

// What the manual gives each frame.
[[nodiscard]] constexpr std::uint8_t length_of(std::uint16_t command) {
  return command == clear_errors ? 1 : command == set_axis_state || command == set_input_torque ? 4 : 8;
}

}  // namespace odrive

template <DriveWiring wiring>
class OdriveDrives {
 public:
  static_assert(wiring.left_node <= 62 && wiring.right_node <= 62,
                "STRIKER DRIVES: an ODrive's node is 0 to 62 (63 is all of them)");

  static constexpr std::uint16_t id(std::size_t wheel, std::uint16_t command) {
    return static_cast<std::uint16_t>(static_cast<std::uint16_t>(wiring.node(wheel)) << 5U | command);
  }
  static constexpr std::array<std::uint16_t, 8> sends = {
      id(left_wheel, odrive::set_input_torque),    id(right_wheel, odrive::set_input_torque),
      id(left_wheel, odrive::set_axis_state),      id(right_wheel, odrive::set_axis_state),
      id(left_wheel, odrive::set_controller_mode), id(right_wheel, odrive::set_controller_mode),
      id(left_wheel, odrive::clear_errors),        id(right_wheel, odrive::clear_errors)};
  static constexpr std::array<std::uint16_t, 6> receives = {id(left_wheel, odrive::get_encoder_estimates),
                                                            id(right_wheel, odrive::get_encoder_estimates),
                                                            id(left_wheel, odrive::heartbeat),
                                                            id(right_wheel, odrive::heartbeat),
                                                            id(left_wheel, odrive::get_error),
                                                            id(right_wheel, odrive::get_error)};
  static constexpr std::size_t most_frames = 3;

  [[nodiscard]] static constexpr bool claims(std::uint16_t identifier) {
    return identifier >> 5U == wiring.left_node || identifier >> 5U == wiring.right_node;
  }
  [[nodiscard]] static bool owns(const Frame& frame) { return is_among(receives, frame.id); }

  [[nodiscard]] Verdict take(const Frame& frame, std::uint32_t tick, DriveReport& report) {
    return pair_.take(news_of(frame), tick - frame.age_ms, report);
  }
  [[nodiscard]] bool invalid() const { return pair_.invalid(); }
  [[nodiscard]] core::Faults judge(std::uint32_t tick) { return pair_.judge(tick); }

  void enable(bool wanted) {
    if (pair_.enable(wanted)) {
      next_step_ = 0;
    }
  }

  void put(const core::DriveCommand& command, FrameList& frames) {
    const core::WheelTorques torque = pair_.follows() ? command.torque : core::WheelTorques{};
    frames.add(torque_frame(left_wheel, torque.left_mNm));
    frames.add(torque_frame(right_wheel, torque.right_mNm));
    put_step(frames);
  }

  // For the command gate. Not inlined: an image holds them once.
  [[nodiscard, gnu::noinline]] static DriveNews news_of(const Frame& frame) {
    DriveNews news = {.wheel = wheel_at(frame.id)};
    if (frame.length != 8) {
      news.verdict = Verdict::wrong_length;
      return news;
    }
    const std::uint32_t first = little_endian_32(frame, 0);
    const std::uint32_t second = little_endian_32(frame, 4);
    switch (frame.id & 0x1FU) {
      case odrive::heartbeat:
        news.is_enabled = first == 0 && (second & 0xFFU) == odrive::closed_loop;
        news.rests = (second & 0xFFU) != odrive::closed_loop;
        break;
      case odrive::get_error:
        if (first != 0) {
          news.is_enabled = false;
        }
        break;
      default:
        news.speed_mm_s = speed_of(news.wheel, first, second);
        news.verdict = news.speed_mm_s ? Verdict::accepted : Verdict::out_of_range;
    }
    return news;
  }

  [[nodiscard, gnu::noinline]] static bool may_send(const Frame& frame) {
    const auto command = static_cast<std::uint16_t>(frame.id & 0x1FU);
    if (!is_among(sends, frame.id) || frame.length != odrive::length_of(command)) {
      return false;
    }
    const std::uint32_t value = little_endian_32(frame, 0);
    switch (command) {
      case odrive::set_input_torque:
        return is_whole_torque(value);
      case odrive::set_axis_state:
        return value == odrive::idle || value == odrive::closed_loop;
      case odrive::set_controller_mode:
        return value == odrive::torque_control && little_endian_32(frame, 4) == odrive::passthrough;
      default:
        return true;
    }
  }

  [[nodiscard]] static std::optional<std::size_t> wheel_of(const Frame& frame) {
    return is_torque(frame) ? std::optional(wheel_at(frame.id)) : std::nullopt;
  }
  [[nodiscard, gnu::noinline]] static core::DriveCommand command_of(const Frame& frame) {
    core::DriveCommand command;
    if (is_torque(frame)) {
      const std::size_t wheel = wheel_at(frame.id);
      const auto torque_mNm = scaled_binary32(little_endian_32(frame, 0), mNm_per_motor_Nm);
      (wheel == left_wheel ? command.torque.left_mNm : command.torque.right_mNm) =
          wiring.sign(wheel) * torque_mNm.value_or(0);
    }
    return command;
  }
  static void recode(Frame& frame, const core::DriveCommand& command) {
    if (is_torque(frame)) {
      const std::size_t wheel = wheel_at(frame.id);
      frame = torque_frame(wheel, wheel == left_wheel ? command.torque.left_mNm : command.torque.right_mNm);
    }
  }
  [[nodiscard]] static bool enables(const Frame& frame) {
    return (frame.id & 0x1FU) == odrive::set_axis_state && little_endian_32(frame, 0) != odrive::idle;
  }
  static void disable(Frame& frame) { put_little_endian_32(frame, 0, odrive::idle); }

 private:
  // 1,000 mNm, times the gear.
  static constexpr std::uint32_t mNm_per_motor_Nm = 10 * static_cast<std::uint32_t>(wiring.gear_percent);
  static constexpr std::uint32_t enabling_steps = 6;
  static constexpr std::uint32_t resting_steps = 2;
  // After those, each wheel's mode again and again: the right one's at an odd step, the left one's at an even one.
  static constexpr std::uint32_t right_mode_step = 25;
  static constexpr std::uint32_t left_mode_step = 50;

  static constexpr std::size_t wheel_at(std::uint16_t identifier) {
    return identifier >> 5U == wiring.left_node ? left_wheel : right_wheel;
  }
  static constexpr bool is_torque(const Frame& frame) {
    return (frame.id & 0x1FU) == odrive::set_input_torque;
  }

  // What is less than a whole mNm would look like none.
  static bool is_whole_torque(std::uint32_t bits) {
    const auto torque_mNm = scaled_binary32(bits, mNm_per_motor_Nm);
    return torque_mNm && binary32_of_ratio(*torque_mNm, mNm_per_motor_Nm) == bits;
  }

  [[gnu::noinline]] static Frame frame_of(std::size_t wheel, std::uint16_t command, std::uint32_t first,
                                          std::uint32_t second = 0) {
    Frame frame = {.id = id(wheel, command), .length = odrive::length_of(command)};
    put_little_endian_32(frame, 0, first);
    put_little_endian_32(frame, 4, second);
    return frame;
  }
  [[gnu::noinline]] static Frame torque_frame(std::size_t wheel, std::int32_t torque_mNm) {
    return frame_of(wheel, odrive::set_input_torque,
                    binary32_of_ratio(wiring.sign(wheel) * torque_mNm, mNm_per_motor_Nm));
  }

  static Frame mode_frame(std::size_t wheel) {
    return frame_of(wheel, odrive::set_controller_mode, odrive::torque_control, odrive::passthrough);
  }

  static std::optional<std::int32_t> speed_of(std::size_t wheel, std::uint32_t turns,
                                              std::uint32_t turns_per_s) {
    const bool is_number = (turns >> 23U & 0xFFU) != 0xFFU;
    const auto speed_um_s = scaled_binary32(turns_per_s, wiring.rim_um_per_turn());
    return is_number && speed_um_s ? rim_speed_mm_s(wiring.sign(wheel) * *speed_um_s) : std::nullopt;
  }

  // One frame a tick beside the torques.
  void put_step(FrameList& frames) {
    if (!pair_.is_wanted()) {
      const std::size_t wheel = next_step_ % 2;
      if (next_step_ < resting_steps || !pair_.rests(wheel)) {
        frames.add(frame_of(wheel, odrive::set_axis_state, odrive::idle));
      }
      next_step_ = next_step_ < resting_steps + 1 ? next_step_ + 1 : resting_steps;
      return;
    }
    const std::size_t wheel = next_step_ % 2;
    if (next_step_ < enabling_steps) {
      const std::uint32_t step = next_step_ / 2;
      frames.add(step == 0   ? frame_of(wheel, odrive::clear_errors, 0)
                 : step == 1 ? mode_frame(wheel)
                             : frame_of(wheel, odrive::set_axis_state, odrive::closed_loop));
    } else if (next_step_ == right_mode_step || next_step_ == left_mode_step) {
      frames.add(mode_frame(wheel));
    }
    next_step_ = next_step_ < left_mode_step ? next_step_ + 1 : enabling_steps;
  }

  DrivePair pair_;
  std::uint32_t next_step_ = resting_steps;
};

}  // namespace striker::can
