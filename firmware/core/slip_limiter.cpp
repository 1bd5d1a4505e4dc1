// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/slip_limiter.hpp"

#include <algorithm>

namespace striker::core {

namespace {

constexpr std::int32_t slip_mm_s = 45;  // three counts of a 14-bit encoder on a rim of 40 mm, in a tick
constexpr std::int32_t coasting_q6 = 96;

constexpr std::int32_t all_q10 = 1024;
constexpr std::int32_t greatest_withheld_q10 = all_q10 - 96;
constexpr std::int32_t late_cut_q10 = 192;

constexpr std::int32_t late_gain_q8 = 256 + 128;
constexpr std::int32_t raise_q8 = 32;
constexpr std::int32_t lower_q8 = 4;
constexpr std::int32_t greatest_learned_q8 = 256;
constexpr std::int32_t least_learned_q8 = -64;

// The current loop needs two ticks to let go. A rim that spins then falls by a count of its encoder or more a tick, and
// by half of the slip in all. One in the air goes on to rise as no robot does, and is not waited for.
constexpr std::int32_t let_go_ticks = 2;
constexpr std::int32_t greatest_cut_ticks = 24;
constexpr std::int32_t fallen_mm_s = slip_mm_s / 2;

constexpr bool is_late(const RobotProfile& robot) {
  return robot.command_delay_ticks != 0;
}

constexpr std::int32_t in_direction(std::int32_t backward, std::int32_t speed_mm_s) {
  return backward != 0 ? -speed_mm_s : speed_mm_s;
}

}  // namespace

void SlipLimiter::see(const RobotProfile& robot, std::int32_t measured_mm_s) {
  if (cut_ticks_ != 0 && !is_late(robot)) {
    regrip(measured_mm_s);
  } else {
    grip(robot, measured_mm_s);
  }
}

void SlipLimiter::grip(const RobotProfile& robot, std::int32_t measured_mm_s) {
  const std::int32_t magnitude_mNm = torque_mNm_ < 0 ? -torque_mNm_ : torque_mNm_;
  const std::int32_t gain_q8 = learned_q8_ + (is_late(robot) ? late_gain_q8 : followed_gain_q8);
  const std::int32_t followed_q6 =
      coasting_q6 + ((((magnitude_mNm * robot.slip_gain_q12) >> 6) * gain_q8) >> 8);
  rolling_q6_ += std::clamp(measured_mm_s * 64 - rolling_q6_, -followed_q6, followed_q6);
  cut_ticks_ = std::max<std::int32_t>(cut_ticks_ - 1, 0);

  backward_ = torque_mNm_ < 0 ? 1 : 0;
  const std::int32_t lead_mm_s = in_direction(backward_, measured_mm_s - rolling_mm_s());
  if (torque_mNm_ == 0 || lead_mm_s <= slip_mm_s) {
    withheld_q10_ = std::max<std::int32_t>(withheld_q10_ - 1, 0);
  } else if (!is_late(robot)) {
    cut_ticks_ = 1;
    spun_mm_s_ = before_mm_s_ = in_direction(backward_, measured_mm_s);
  } else if (cut_ticks_ == 0) {
    cut_ticks_ = robot.command_delay_ticks + 1;
    withheld_q10_ = std::min(withheld_q10_ + late_cut_q10, greatest_withheld_q10);
  }
}

void SlipLimiter::regrip(std::int32_t measured_mm_s) {
  const std::int32_t now_mm_s = in_direction(backward_, measured_mm_s);
  const bool falls = now_mm_s < before_mm_s_;
  before_mm_s_ = now_mm_s;
  ++cut_ticks_;
  if (cut_ticks_ <= let_go_ticks || (falls && cut_ticks_ < greatest_cut_ticks)) {
    return;
  }
  const std::int32_t fell_mm_s = spun_mm_s_ - now_mm_s;
  learn(fell_mm_s > fallen_mm_s || fell_mm_s < -slip_mm_s);
  rolling_q6_ = measured_mm_s * 64;
  cut_ticks_ = 0;
}

void SlipLimiter::learn(bool spun) {
  if (spun) {
    withheld_q10_ = std::min(withheld_q10_ + (all_q10 - withheld_q10_) / 8, greatest_withheld_q10);
    learned_q8_ = std::max(learned_q8_ - lower_q8, least_learned_q8);
  } else {
    learned_q8_ = std::min(learned_q8_ + raise_q8, greatest_learned_q8);
  }
}

std::int32_t SlipLimiter::limit_mNm(const RobotProfile& robot) const {
  const std::int32_t gripping_mNm = (robot.torque_limit_mNm * (all_q10 - withheld_q10_)) >> 10;
  return cut_ticks_ != 0 && !is_late(robot) ? std::max<std::int32_t>(gripping_mNm / 32, 1) : gripping_mNm;
}

}  // namespace striker::core
