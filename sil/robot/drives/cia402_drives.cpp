// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/drives/cia402_drives.hpp"

#include <cmath>
#include <cstring>
#include <numbers>

namespace striker::sil {

namespace {

constexpr std::uint32_t command_timeout_ticks = 10;
constexpr std::uint32_t producer_heartbeat_ticks = 10;
constexpr std::uint8_t cyclic_synchronous_torque = 10;

std::uint16_t identifier(std::uint32_t function, std::int32_t node) {
  return static_cast<std::uint16_t>(function + static_cast<std::uint32_t>(node));
}

}  // namespace

void Cia402Drives::take(const can::Frame& frame, std::uint32_t tick) {
  for (std::size_t wheel = 0; wheel < nodes_.size(); ++wheel) {
    Node& node = nodes_[wheel];
    const std::int32_t number = wiring_.node(wheel);
    if (node.is_gone) {
      continue;
    }
    if (frame.id == 0x000 && frame.length == 2 && (frame.data[1] == 0 || frame.data[1] == number)) {
      node.is_operational = frame.data[0] == 1;
    } else if (frame.id == identifier(0x200, number) && frame.length == 5 && node.is_operational) {
      std::memcpy(&node.control_word, &frame.data[0], 2);
      std::memcpy(&node.torque_per_mille, &frame.data[2], 2);
      node.mode = frame.data[4];
      node.commanded_tick = tick;
      obey(node);
    } else if (frame.id == 0x080 && frame.length == 0 && node.is_operational) {
      node.has_to_tell = true;
    }
  }
  order();
}

// CiA 402's state machine: transitions 2 to 9 and 15, as far as these control words lead.
void Cia402Drives::obey(Node& node) {
  const std::uint32_t low = node.control_word & 0x0FU;
  const bool resets = (node.control_word & 0x80U) != 0 && (node.last_control_word & 0x80U) == 0;
  node.last_control_word = node.control_word;
  if (node.state == State::fault) {
    node.state = resets ? State::switch_on_disabled : State::fault;
  } else if ((low & 0x02U) == 0) {
    node.state = State::switch_on_disabled;  // disable voltage
  } else if ((low & 0x07U) == 0x06) {
    node.state = State::ready_to_switch_on;  // shutdown
  } else if (low == 0x07) {
    node.state = node.state == State::switch_on_disabled ? node.state : State::switched_on;
  } else if (low == 0x0F && (node.state == State::switched_on || node.state == State::operation_enabled)) {
    node.state = State::operation_enabled;
  }
}

void Cia402Drives::order() {
  for (std::size_t wheel = 0; wheel < nodes_.size(); ++wheel) {
    const Node& node = nodes_[wheel];
    const bool follows = node.state == State::operation_enabled && node.is_operational && !node.is_gone &&
                         node.mode == cyclic_synchronous_torque;
    const double rated_Nm = wiring_.rated_torque_mNm * 1e-3 * wiring_.gear_percent / 100.0;
    orders_[wheel] = {.torque_Nm =
                          follows ? wiring_.sign(wheel) * node.torque_per_mille * 1e-3 * rated_Nm : 0.0};
  }
}

bool Cia402Drives::cut(std::uint32_t) const {
  return nodes_[0].state != State::operation_enabled && nodes_[1].state != State::operation_enabled;
}

void Cia402Drives::report(const RimSpeeds& speeds, std::uint32_t tick, std::vector<can::Frame>& frames) {
  const double around_m = 2.0 * std::numbers::pi * wiring_.wheel_radius_um * 1e-6;
  for (std::size_t wheel = 0; wheel < nodes_.size(); ++wheel) {
    Node& node = nodes_[wheel];
    const std::int32_t number = wiring_.node(wheel);
    if (node.is_gone) {
      continue;
    }
    if (node.state == State::operation_enabled && tick - node.commanded_tick >= command_timeout_ticks) {
      node.state = State::fault;
      node.has_emergency = true;
    }
    if (node.has_emergency) {
      node.has_emergency = false;
      can::Frame frame = {.id = identifier(0x080, number), .length = 8};
      frame.data = {0x30, 0x81, 0x11};  // 8130h: life guard or heartbeat error
      frames.push_back(frame);
    }
    if (node.has_to_tell) {
      node.has_to_tell = false;
      can::Frame frame = {.id = identifier(0x180, number), .length = 6};
      std::memcpy(&frame.data[0], &node.state, 2);
      std::memcpy(&frame.data[2], &node.counts_per_s, 4);
      frames.push_back(frame);
    }
    if (tick % producer_heartbeat_ticks == 5 * wheel) {
      can::Frame frame = {.id = identifier(0x700, number), .length = 1};
      frame.data[0] = node.is_operational ? 0x05 : 0x7F;
      frames.push_back(frame);
    }
    // For the next SYNC.
    const double rim_m_s = wheel == can::left_wheel ? speeds.left_m_s : speeds.right_m_s;
    const double turns_s = rim_m_s / around_m * wiring_.gear_percent / 100.0;
    node.counts_per_s =
        wiring_.sign(wheel) * static_cast<std::int32_t>(std::lround(turns_s * wiring_.counts_per_turn));
  }
  order();
}

void Cia402Drives::fail(std::size_t wheel, DriveFailure failure) {
  Node& node = nodes_[wheel];
  node.is_gone = failure == DriveFailure::gone;
  node.has_emergency = failure == DriveFailure::error;
  node.state = failure == DriveFailure::error ? State::fault : State::switch_on_disabled;
  order();
}

}  // namespace striker::sil
