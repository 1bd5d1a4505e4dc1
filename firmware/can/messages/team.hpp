// SPDX-License-Identifier: Apache-2.0
// What a team orders its robot to do, once every 50 ms: wheel speeds, or a motion that the controller knows.
//
// Both are one sequence with one E2E counter, as an order takes the place of the one before it, whichever message it
// comes in: send(WheelOrder{...}, counter), then send(MotionOrder{...}, counter).
// Within the decision window after its picture an order that begins a motion keeps it in phase with the camera.
// An order is good for `core::order_timeout_ticks`; what it does is in firmware/core/orders/standing_order.hpp.
#pragma once

#include "firmware/can/layout.hpp"
#include "firmware/core/decision_clock.hpp"
#include "firmware/core/orders/standing_order.hpp"
#include "firmware/core/tick.hpp"

namespace striker::can {

// The robot cuts each wheel to its own top speed.
struct WheelOrder {
  std::int32_t left_mm_s = 0;  // rim speed, positive forward
  std::int32_t right_mm_s = 0;
};

template <>
inline constexpr auto layout<WheelOrder> =
    Layout<WheelOrder, 2>{.info = {.name = "WheelOrder",
                                   .id = moved(0x084),
                                   .length = 6,
                                   .sender = Node::team,
                                   .period_ms = core::decision_period_ms,
                                   .timeout_ms = core::order_timeout_ticks,
                                   .data_ids = 13,
                                   .comment = "Set-points of both wheels.",
                                   .traffic = due_within(core::decision_window_ticks)},
                          .signals = {{{.name = "left_set_point",
                                        .field = &WheelOrder::left_mm_s,
                                        .first_bit = 16,
                                        .bits = 16,
                                        .is_signed = true,
                                        .minimum = -8000,
                                        .maximum = 8000,
                                        .unit = "mm/s"},
                                       {.name = "right_set_point",
                                        .field = &WheelOrder::right_mm_s,
                                        .first_bit = 32,
                                        .bits = 16,
                                        .is_signed = true,
                                        .minimum = -8000,
                                        .maximum = 8000,
                                        .unit = "mm/s"}}}};

enum class Motion : std::uint8_t { kick = 0 };

inline constexpr std::array<std::string_view, 1> motion_names = {"kick"};
inline constexpr auto motion_values = named_values(motion_names);

struct MotionOrder {
  std::int32_t number = 0;        // another one than before begins the motion anew; after 3 comes 0
  std::int32_t motion = 0;        // Motion
  std::int32_t x_quarter_mm = 0;  // the target, as in VisionPose; the kick, at the goal, has no use for it
  std::int32_t y_quarter_mm = 0;
  std::int32_t heading = 0;  // binary angle
};

template <>
inline constexpr auto layout<MotionOrder> =
    Layout<MotionOrder, 5>{.info = {.name = "MotionOrder",
                                    .id = moved(0x088),
                                    .length = 8,
                                    .sender = Node::team,
                                    .period_ms = core::decision_period_ms,
                                    .timeout_ms = core::order_timeout_ticks,
                                    .data_ids = 14,
                                    .comment = "A motion to begin, or to go on with, and its target.",
                                    .traffic = due_within(core::decision_window_ticks)},
                           .signals = {{{.name = "number",
                                         .field = &MotionOrder::number,
                                         .first_bit = 12,
                                         .bits = 2,
                                         .maximum = core::motion_numbers - 1},
                                        {.name = "motion",
                                         .field = &MotionOrder::motion,
                                         .first_bit = 14,
                                         .bits = 2,
                                         .maximum = last_of(motion_values),
                                         .values = motion_values},
                                        {.name = "x",
                                         .field = &MotionOrder::x_quarter_mm,
                                         .first_bit = 16,
                                         .bits = 16,
                                         .is_signed = true,
                                         .minimum = -32768,
                                         .maximum = 32767,
                                         .scale = units::quarter,
                                         .unit = "mm"},
                                        {.name = "y",
                                         .field = &MotionOrder::y_quarter_mm,
                                         .first_bit = 32,
                                         .bits = 16,
                                         .is_signed = true,
                                         .minimum = -32768,
                                         .maximum = 32767,
                                         .scale = units::quarter,
                                         .unit = "mm"},
                                        {.name = "heading",
                                         .field = &MotionOrder::heading,
                                         .first_bit = 48,
                                         .bits = 16,
                                         .is_signed = true,
                                         .minimum = -32768,
                                         .maximum = 32767,
                                         .scale = units::circle_65536th_deg,
                                         .unit = "deg"}}}};

}  // namespace striker::can
