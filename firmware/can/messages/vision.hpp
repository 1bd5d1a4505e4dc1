// SPDX-License-Identifier: Apache-2.0
// What the camera sees, in two frames a picture that share a 4-bit number. Positions from the field's centre, x
// towards the opponent's goal, y to the left.
#pragma once

#include "firmware/can/layout.hpp"
#include "firmware/core/decision_clock.hpp"
#include "firmware/core/percepts.hpp"
#include "firmware/core/tick.hpp"

namespace striker::can {

inline constexpr std::int32_t um_per_quarter_mm = 250;

struct VisionPose {
  std::int32_t frame = 0;         // the picture's number
  std::int32_t x_quarter_mm = 0;  // a count is 0.25 mm
  std::int32_t y_quarter_mm = 0;
  std::int32_t heading = 0;  // binary angle: 2^16 counts are the full circle
};

template <>
inline constexpr auto layout<VisionPose> =
    Layout<VisionPose, 4>{.info = {.name = "VisionPose",
                                   .id = moved(0x070),
                                   .length = 8,
                                   .sender = Node::vision,
                                   .period_ms = core::decision_period_ms,
                                   .timeout_ms = core::vision_timeout_ticks,
                                   .data_ids = 7,
                                   .comment = "The robot, as the camera sees it.",
                                   .traffic = due_within(core::decision_window_ticks)},
                          .signals = {{{.name = "frame",
                                        .field = &VisionPose::frame,
                                        .first_bit = 12,
                                        .bits = 4,
                                        .maximum = core::picture_numbers - 1},
                                       {.name = "x",
                                        .field = &VisionPose::x_quarter_mm,
                                        .first_bit = 16,
                                        .bits = 16,
                                        .is_signed = true,
                                        .minimum = -32768,
                                        .maximum = 32767,
                                        .scale = units::quarter,
                                        .unit = "mm"},
                                       {.name = "y",
                                        .field = &VisionPose::y_quarter_mm,
                                        .first_bit = 32,
                                        .bits = 16,
                                        .is_signed = true,
                                        .minimum = -32768,
                                        .maximum = 32767,
                                        .scale = units::quarter,
                                        .unit = "mm"},
                                       {.name = "heading",
                                        .field = &VisionPose::heading,
                                        .first_bit = 48,
                                        .bits = 16,
                                        .is_signed = true,
                                        .minimum = -32768,
                                        .maximum = 32767,
                                        .scale = units::circle_65536th_deg,
                                        .unit = "deg"}}}};

struct VisionBall {
  std::int32_t frame = 0;
  std::int32_t x_quarter_mm = 0;
  std::int32_t y_quarter_mm = 0;
};

template <>
inline constexpr auto layout<VisionBall> =
    Layout<VisionBall, 3>{.info = {.name = "VisionBall",
                                   .id = moved(0x080),
                                   .length = 6,
                                   .sender = Node::vision,
                                   .period_ms = core::decision_period_ms,
                                   .timeout_ms = core::vision_timeout_ticks,
                                   .data_ids = 8,
                                   .comment = "The ball in the same picture.",
                                   .traffic = due_within(core::decision_window_ticks)},
                          .signals = {{{.name = "frame",
                                        .field = &VisionBall::frame,
                                        .first_bit = 12,
                                        .bits = 4,
                                        .maximum = core::picture_numbers - 1},
                                       {.name = "x",
                                        .field = &VisionBall::x_quarter_mm,
                                        .first_bit = 16,
                                        .bits = 16,
                                        .is_signed = true,
                                        .minimum = -32768,
                                        .maximum = 32767,
                                        .scale = units::quarter,
                                        .unit = "mm"},
                                       {.name = "y",
                                        .field = &VisionBall::y_quarter_mm,
                                        .first_bit = 32,
                                        .bits = 16,
                                        .is_signed = true,
                                        .minimum = -32768,
                                        .maximum = 32767,
                                        .scale = units::quarter,
                                        .unit = "mm"}}}};

}  // namespace striker::can
