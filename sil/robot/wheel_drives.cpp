#include "sil/robot/wheel_drives.hpp"

#include <cmath>

namespace striker::sil {

namespace {

std::int32_t to_mm_s(double speed_m_s) {
  return static_cast<std::int32_t>(std::lround(speed_m_s * 1000.0));
}

}  // namespace

void WheelDrives::take(const can::Frame& frame, std::uint32_t tick) {
  if (!can::is<can::WheelCommand>(frame)) {
    return;
  }
  receive_counter_.seen = receive_counter_.seen && !cut(tick);
  if (can::receive(frame, receive_counter_, command_) != can::Verdict::accepted) {
    ++ignored_;
    return;
  }
  command_tick_ = tick;
  commanded_ = true;
}

can::Frame WheelDrives::state_frame(const RimSpeeds& speeds, std::uint32_t tick) {
  return can::send(can::WheelState{.torque_cut = static_cast<std::int32_t>(cut(tick)),
                                   .left_mm_s = to_mm_s(speeds.left_m_s),
                                   .right_mm_s = to_mm_s(speeds.right_m_s)},
                   send_counter_);
}

}  // namespace striker::sil
