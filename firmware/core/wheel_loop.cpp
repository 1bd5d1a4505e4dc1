#include "firmware/core/wheel_loop.hpp"

#include <algorithm>

namespace striker::core {

namespace {

constexpr std::int32_t kp_q8 = 922;         // 3.6 mNm/(mm/s)
constexpr std::int32_t ki_tick_q16 = 2359;  // 36 mNm/(mm/s)/s at 1 kHz
constexpr std::int32_t integral_limit_q16 = torque_limit_mNm * 65536;

}  // namespace

std::int32_t WheelLoop::step(std::int32_t set_point_mm_s, std::int32_t measured_mm_s) {
  const std::int32_t error_mm_s = set_point_mm_s - measured_mm_s;
  const std::int32_t wanted_mNm = ((error_mm_s * kp_q8) >> 8) + (integral_q16_ >> 16);
  const std::int32_t torque_mNm = std::clamp(wanted_mNm, -torque_limit_mNm, torque_limit_mNm);
  const bool winds_up =
      (wanted_mNm > torque_limit_mNm && error_mm_s > 0) || (wanted_mNm < -torque_limit_mNm && error_mm_s < 0);
  if (!winds_up) {
    integral_q16_ =
        std::clamp(integral_q16_ + error_mm_s * ki_tick_q16, -integral_limit_q16, integral_limit_q16);
  }
  return torque_mNm;
}

}  // namespace striker::core
