// SPDX-License-Identifier: Apache-2.0
#include "sil/match/play/order_sender.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "firmware/can/messages/team.hpp"

namespace striker::sil {

namespace {

constexpr double mm_a_m = 1e3;
constexpr double quarter_mm_a_m = 4e3;
constexpr double angles_a_circle = 65'536.0;

std::int32_t counts(double value, std::int32_t most) {
  if (std::isnan(value)) {
    return 0;
  }
  return static_cast<std::int32_t>(std::lround(std::clamp(value, -1.0 * most, 1.0 * most)));
}

std::int32_t binary_angle(double angle_rad) {
  const double turns = std::isfinite(angle_rad) ? angle_rad / (2.0 * std::numbers::pi) : 0.0;
  const auto angle = std::lround((turns - std::round(turns)) * angles_a_circle);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(angle));
}

constexpr std::int32_t greatest_speed_mm_s = 8'000;
constexpr std::int32_t greatest_place = std::numeric_limits<std::int16_t>::max();

can::WheelOrder message_of(const SpeedOrder& order) {
  return {.left_mm_s = counts(order.left_m_s * mm_a_m, greatest_speed_mm_s),
          .right_mm_s = counts(order.right_m_s * mm_a_m, greatest_speed_mm_s)};
}

can::MotionOrder message_of(const MotionOrder& order) {
  return {.number = order.number % 4,
          .motion = static_cast<std::int32_t>(can::Motion::kick),
          .x_quarter_mm = counts(order.target.x_m * quarter_mm_a_m, greatest_place),
          .y_quarter_mm = counts(order.target.y_m * quarter_mm_a_m, greatest_place),
          .heading = binary_angle(order.target.heading_rad)};
}

}  // namespace

can::Frame OrderSender::frame(const RobotOrder& order) {
  return std::visit([this](const auto& given) { return can::send(message_of(given), counter_); }, order);
}

std::optional<RobotOrder> order_in(const can::Frame& frame) {
  can::WheelOrder speeds;
  can::MotionOrder motion;
  if (can::is<can::WheelOrder>(frame) && can::receive(frame, speeds) == can::Verdict::accepted) {
    return SpeedOrder{speeds.left_mm_s / mm_a_m, speeds.right_mm_s / mm_a_m};
  }
  if (can::is<can::MotionOrder>(frame) && can::receive(frame, motion) == can::Verdict::accepted) {
    return MotionOrder{.motion = Motion::kick,
                       .number = static_cast<std::uint8_t>(motion.number),
                       .target = {motion.x_quarter_mm / quarter_mm_a_m, motion.y_quarter_mm / quarter_mm_a_m,
                                  motion.heading * 2.0 * std::numbers::pi / angles_a_circle}};
  }
  return std::nullopt;
}

}  // namespace striker::sil
