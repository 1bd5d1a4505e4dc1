// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/striker_drives.hpp"

#include <cmath>

namespace striker::sil {

namespace {

std::int32_t to_mm_s(double speed_m_s) {
  return static_cast<std::int32_t>(std::lround(speed_m_s * 1000.0));
}

WheelOrder order_of(std::int32_t torque_mNm, std::int32_t set_point_2mm_s) {
  return {.torque_Nm = torque_mNm * 1e-3, .rim_speed_m_s = set_point_2mm_s * 2e-3};
}

}  // namespace

void StrikerDrives::take(const can::Frame& frame, std::uint32_t tick) {
  if (!can::is<can::WheelCommand>(frame)) {
    return;
  }
  can::WheelCommand command;
  if (receiver_.take(frame, tick, command) != can::Verdict::accepted) {
    ++ignored_;
    return;
  }
  orders_ = {order_of(command.left_torque_mNm, command.left_set_point_2mm_s),
             order_of(command.right_torque_mNm, command.right_set_point_2mm_s)};
  command_.feed(tick - frame.age_ms);
}

void StrikerDrives::report(const RimSpeeds& speeds, std::uint32_t tick, std::vector<can::Frame>& frames) {
  command_.expire(tick, timeout_ticks - 1);
  frames.push_back(can::send(can::WheelState{.torque_cut = static_cast<std::int32_t>(cut(tick)),
                                             .left_mm_s = to_mm_s(speeds.left_m_s),
                                             .right_mm_s = to_mm_s(speeds.right_m_s)},
                             send_counter_));
}

}  // namespace striker::sil
