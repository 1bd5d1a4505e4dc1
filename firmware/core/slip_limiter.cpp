// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/slip_limiter.hpp"

#include <algorithm>

namespace striker::core {

namespace {

constexpr std::int32_t slip_mm_s = 45;  // three counts of a 14-bit encoder on a rim of 40 mm, in a tick
constexpr std::int32_t coasting_q6 = 96;
constexpr std::int32_t all_q8 = 256;
constexpr std::int32_t cut_q8 = 24;
constexpr std::int32_t late_cut_q8 = 48;
constexpr std::int32_t least_q8 = 24;

}  // namespace

std::int32_t SlipLimiter::limit(const RobotProfile& robot, std::int32_t measured_mm_s) {
  const std::int32_t magnitude_mNm = torque_mNm_ < 0 ? -torque_mNm_ : torque_mNm_;
  const std::int32_t followed_q6 = coasting_q6 + ((magnitude_mNm * robot.slip_gain_q12) >> 6);
  reference_q6_ += std::clamp(measured_mm_s * 64 - reference_q6_, -followed_q6, followed_q6);
  const std::int32_t lead_mm_s = measured_mm_s - (reference_q6_ >> 6);
  const bool spins =
      (lead_mm_s > slip_mm_s && torque_mNm_ > 0) || (lead_mm_s < -slip_mm_s && torque_mNm_ < 0);
  if (spins && settling_ticks_ == 0) {
    const std::int32_t cut = robot.command_delay_ticks == 0 ? cut_q8 : late_cut_q8;
    withheld_q8_ = std::min(withheld_q8_ + cut, all_q8 - least_q8);
    settling_ticks_ = robot.command_delay_ticks;
  } else {
    withheld_q8_ = spins ? withheld_q8_ : std::max<std::int32_t>(withheld_q8_ - 1, 0);
    settling_ticks_ = std::max<std::int32_t>(settling_ticks_ - 1, 0);
  }
  return (robot.torque_limit_mNm * (all_q8 - withheld_q8_)) >> 8;
}

}  // namespace striker::core
