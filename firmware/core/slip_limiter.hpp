// SPDX-License-Identifier: Apache-2.0
// Keeps a driven wheel from spinning, and knows how fast the robot rolls when it does: a rim that runs away from what the
// robot can follow loses its torque until it grips. Then the torque comes back, a little less of it, and rises slowly.
//
// Gripping: the rolling speed follows the measured rim, no faster than the last torque accelerates the robot (the
// profile's gain, a tenth to spare, and 1.5 mm/s a tick for what else moves it: a ball, another robot, a slope). A rim
// that leads it by more than 45 mm/s in the torque's direction is taken to spin.
// Regripping: hardly any torque, until the rim no longer falls; then its speed is the robot's. A rim that fell did spin:
// of the torque limit an eighth of what was left is withheld, and each tick of gripping gives a 1024th of it all back.
// One that stays grips, on a robot that is lighter or stronger than described: the gain is raised by an eighth.
// So the wheel works near the torque at which it spins, and finds it anew all the time: neither friction nor mass need
// be known.
//
// Where commands are late the rim tells too late whether it grips. There half of the gain is to spare, a cut takes a
// fifth of the whole limit, and the next one waits until this one acts.
//
//   slip.see(robot, measured_mm_s);
//   torque_mNm = clamp(wanted_mNm, -slip.limit_mNm(robot), slip.limit_mNm(robot));
//   slip.acts(torque_mNm);
//
// Once a tick. Speeds within +-8000 mm/s; about forty instructions, three of them multiplications.
#pragma once

#include <cstdint>

#include "firmware/core/robot_profile.hpp"

namespace striker::core {

// Of the profile's gain, what a rim may gain at first.
inline constexpr std::int32_t followed_gain_q8 = 256 + 26;

class SlipLimiter {
 public:
  SlipLimiter() = default;
  explicit SlipLimiter(std::int32_t rolling_mm_s) : rolling_q6_(rolling_mm_s * 64) {}

  void see(const RobotProfile& robot, std::int32_t measured_mm_s);

  // The greatest torque for this tick, at least 1 mNm.
  [[nodiscard]] std::int32_t limit_mNm(const RobotProfile& robot) const;

  // What acts on the wheel in this tick.
  void acts(std::int32_t torque_mNm) { torque_mNm_ = torque_mNm; }
  [[nodiscard]] std::int32_t acting_mNm() const { return torque_mNm_; }

  // Of a rim that grips.
  [[nodiscard]] std::int32_t rolling_mm_s() const { return rolling_q6_ >> 6; }

 private:
  void grip(const RobotProfile& robot, std::int32_t measured_mm_s);
  void regrip(std::int32_t measured_mm_s);
  void learn(bool spun);

  // Whole words: they are part of the sealed state (seal.hpp).
  std::int32_t rolling_q6_ = 0;    // mm/s
  std::int32_t before_mm_s_ = 0;   // regripping: the last measurement, and the one when it began,
  std::int32_t spun_mm_s_ = 0;     // both in the direction of the torque of then
  std::int32_t backward_ = 0;      // that direction
  std::int32_t withheld_q10_ = 0;  // of the torque limit
  std::int32_t learned_q8_ = 0;    // of the gain, beside the profile's
  std::int32_t torque_mNm_ = 0;    // that acts
  std::int32_t cut_ticks_ = 0;     // since regripping began; of late commands: until the last cut acts
};

}  // namespace striker::core
