// SPDX-License-Identifier: Apache-2.0
// Striker's own wheel drives: a torque command every tick, and the measured rim speeds back.
#pragma once

#include "firmware/can/layout.hpp"
#include "firmware/core/percepts.hpp"

namespace striker::can {

struct WheelCommand {
  std::int32_t left_torque_mNm = 0;
  std::int32_t right_torque_mNm = 0;
  std::int32_t left_set_point_2mm_s = 0;  // a count is 2 mm/s
  std::int32_t right_set_point_2mm_s = 0;
};

template <>
inline constexpr auto layout<WheelCommand> =
    Layout<WheelCommand, 4>{.info = {.name = "WheelCommand",
                                     .id = moved(0x050),
                                     .length = 8,
                                     .sender = Node::controller,
                                     .period_ms = 1,
                                     .timeout_ms = 10,
                                     .data_ids = 5,
                                     .comment = "Torque and set-point of both wheels."},
                            .signals = {{{.name = "left_torque",
                                          .field = &WheelCommand::left_torque_mNm,
                                          .first_bit = 16,
                                          .bits = 12,
                                          .is_signed = true,
                                          .minimum = -2000,
                                          .maximum = 2000,
                                          .unit = "mNm"},
                                         {.name = "right_torque",
                                          .field = &WheelCommand::right_torque_mNm,
                                          .first_bit = 28,
                                          .bits = 12,
                                          .is_signed = true,
                                          .minimum = -2000,
                                          .maximum = 2000,
                                          .unit = "mNm"},
                                         {.name = "left_set_point",
                                          .field = &WheelCommand::left_set_point_2mm_s,
                                          .first_bit = 40,
                                          .bits = 12,
                                          .is_signed = true,
                                          .minimum = -2000,
                                          .maximum = 2000,
                                          .scale = units::two,
                                          .unit = "mm/s"},
                                         {.name = "right_set_point",
                                          .field = &WheelCommand::right_set_point_2mm_s,
                                          .first_bit = 52,
                                          .bits = 12,
                                          .is_signed = true,
                                          .minimum = -2000,
                                          .maximum = 2000,
                                          .scale = units::two,
                                          .unit = "mm/s"}}}};

struct WheelState {
  std::int32_t torque_cut = 0;  // 1: the drives' own watchdog holds the torque at 0
  std::int32_t left_mm_s = 0;   // rim speed, positive forward
  std::int32_t right_mm_s = 0;
};

template <>
inline constexpr auto layout<WheelState> = Layout<WheelState, 3>{
    .info = {.name = "WheelState",
             .id = moved(0x060),
             .length = 6,
             .sender = Node::drives,
             .period_ms = 1,
             .timeout_ms = core::wheel_timeout_ticks,
             .data_ids = 6,
             .comment = "Measured rim speeds."},
    .signals = {
        {{.name = "torque_cut", .field = &WheelState::torque_cut, .first_bit = 12, .bits = 1, .maximum = 1},
         {.name = "left_speed",
          .field = &WheelState::left_mm_s,
          .first_bit = 16,
          .bits = 16,
          .is_signed = true,
          .minimum = -8000,
          .maximum = 8000,
          .unit = "mm/s"},
         {.name = "right_speed",
          .field = &WheelState::right_mm_s,
          .first_bit = 32,
          .bits = 16,
          .is_signed = true,
          .minimum = -8000,
          .maximum = 8000,
          .unit = "mm/s"}}}};

}  // namespace striker::can
