#include "firmware/core/command_check.hpp"

#include "firmware/core/wheel_loop.hpp"

namespace striker::core {

namespace {

constexpr std::int32_t magnitude(std::int32_t value) {
  return value < 0 ? -value : value;
}

constexpr bool drives_overspeed(std::int32_t torque_mNm, std::int32_t speed_mm_s) {
  return magnitude(speed_mm_s) > overspeed_mm_s && torque_mNm != 0 && (torque_mNm > 0) == (speed_mm_s > 0);
}

}  // namespace

can::Fault check_command(const can::WheelCommand& command, const DriveFacts& facts) {
  const bool moves = command.left_torque_mNm != 0 || command.right_torque_mNm != 0 ||
                     command.left_set_point_2mm_s != 0 || command.right_set_point_2mm_s != 0;
  if (!moves) {
    return can::Fault::none;
  }
  const bool has_cause = facts.armed && facts.vision_fresh && facts.wheels_fresh;
  const bool in_limits = magnitude(command.left_torque_mNm) <= torque_limit_mNm &&
                         magnitude(command.right_torque_mNm) <= torque_limit_mNm &&
                         magnitude(command.left_set_point_2mm_s) * 2 <= top_rim_speed_mm_s &&
                         magnitude(command.right_set_point_2mm_s) * 2 <= top_rim_speed_mm_s;
  if (!has_cause || !in_limits) {
    return can::Fault::command_rejected;
  }
  if (drives_overspeed(command.left_torque_mNm, facts.wheels.left_mm_s) ||
      drives_overspeed(command.right_torque_mNm, facts.wheels.right_mm_s)) {
    return can::Fault::overspeed;
  }
  return can::Fault::none;
}

}  // namespace striker::core
