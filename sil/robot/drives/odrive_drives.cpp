// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/drives/odrive_drives.hpp"

#include <bit>
#include <cstring>
#include <numbers>

namespace striker::sil {

namespace {

constexpr std::uint8_t idle = 1;
constexpr std::uint8_t closed_loop = 8;
constexpr std::uint32_t start_ticks = 2;
constexpr std::uint32_t watchdog_ticks = 10;
constexpr std::uint32_t heartbeat_ticks = 10;
constexpr std::uint32_t watchdog_timer_expired = 0x0100'0000;
constexpr std::uint32_t drv_fault = 0x20;

std::uint32_t word_at(const can::Frame& frame, std::size_t byte) {
  std::uint32_t word = 0;
  std::memcpy(&word, &frame.data[byte], sizeof word);
  return word;
}

double turns_per_m(const can::DriveWiring& wiring) {
  const double around_m = 2.0 * std::numbers::pi * wiring.wheel_radius_um * 1e-6;
  return wiring.gear_percent / 100.0 / around_m;
}

std::uint32_t bits_of(double value) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

}  // namespace

void OdriveDrives::take(const can::Frame& frame, std::uint32_t tick) {
  for (std::size_t wheel = 0; wheel < axes_.size(); ++wheel) {
    if (frame.id >> 5U == wiring_.node(wheel) && !axes_[wheel].is_gone) {
      obey(axes_[wheel], frame.id & 0x1FU, frame, tick);
    }
  }
  order();
}

void OdriveDrives::obey(Axis& axis, std::uint32_t command, const can::Frame& frame, std::uint32_t tick) {
  if (command == 0x07 && frame.length == 4) {  // Set_Axis_State
    const std::uint32_t wanted = word_at(frame, 0);
    axis.is_starting = wanted == closed_loop && axis.error == 0;
    axis.starts_tick = tick + start_ticks;
    axis.state = idle;
  } else if (command == 0x0B && frame.length == 8) {  // Set_Controller_Mode: torque control, passthrough
    axis.controls_torque = word_at(frame, 0) == 1 && word_at(frame, 4) == 1;
  } else if (command == 0x0E && frame.length == 4) {  // Set_Input_Torque
    axis.torque_Nm = std::bit_cast<float>(word_at(frame, 0));
    axis.fed_tick = tick;
  } else if (command == 0x18 && frame.length <= 1) {  // Clear_Errors
    axis.error = 0;
  }
}

void OdriveDrives::pass_time(Axis& axis, std::uint32_t tick) {
  if (axis.is_starting && tick >= axis.starts_tick) {
    axis.is_starting = false;
    axis.state = closed_loop;
  }
  if (axis.state == closed_loop && tick - axis.fed_tick >= watchdog_ticks) {
    axis.error |= watchdog_timer_expired;
    axis.state = idle;
  }
}

void OdriveDrives::order() {
  for (std::size_t wheel = 0; wheel < axes_.size(); ++wheel) {
    const Axis& axis = axes_[wheel];
    const bool follows = axis.state == closed_loop && axis.controls_torque && !axis.is_gone;
    const double gear = wiring_.gear_percent / 100.0;
    orders_[wheel] = {.torque_Nm = follows ? wiring_.sign(wheel) * axis.torque_Nm * gear : 0.0};
  }
}

bool OdriveDrives::cut(std::uint32_t) const {
  return axes_[0].state != closed_loop && axes_[1].state != closed_loop;
}

can::Frame OdriveDrives::frame_of(std::size_t wheel, std::uint32_t command, std::uint32_t first,
                                  std::uint32_t second) const {
  can::Frame frame = {
      .id = static_cast<std::uint16_t>(static_cast<std::uint32_t>(wiring_.node(wheel)) << 5U | command),
      .length = 8};
  std::memcpy(&frame.data[0], &first, sizeof first);
  std::memcpy(&frame.data[4], &second, sizeof second);
  return frame;
}

void OdriveDrives::report(const RimSpeeds& speeds, std::uint32_t tick, std::vector<can::Frame>& frames) {
  for (std::size_t wheel = 0; wheel < axes_.size(); ++wheel) {
    Axis& axis = axes_[wheel];
    if (axis.is_gone) {
      continue;
    }
    pass_time(axis, tick);
    const double rim_m_s = wheel == can::left_wheel ? speeds.left_m_s : speeds.right_m_s;
    const double turns_s = wiring_.sign(wheel) * rim_m_s * turns_per_m(wiring_);
    axis.turns += turns_s * tick_s;
    frames.push_back(frame_of(wheel, 0x09, bits_of(axis.turns), bits_of(turns_s)));
    if (tick % heartbeat_ticks == 5 * wheel) {
      frames.push_back(frame_of(wheel, 0x01, axis.error, axis.state));
    }
  }
  order();
}

void OdriveDrives::fail(std::size_t wheel, DriveFailure failure) {
  Axis& axis = axes_[wheel];
  axis.state = idle;
  axis.is_starting = false;
  axis.is_gone = failure == DriveFailure::gone;
  axis.error |= failure == DriveFailure::error ? drv_fault : 0;
  order();
}

}  // namespace striker::sil
