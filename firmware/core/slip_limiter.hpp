// SPDX-License-Identifier: Apache-2.0
// Keeps a driven wheel from spinning: less torque as soon as its rim runs away from what the robot can follow, and
// all of it again, slowly, when it grips.
//
// The reference follows the measured rim speed, but no faster than the last torque can accelerate the robot: by the
// profile's gain, half as much again for a robot that is lighter or stronger than described, and 1.5 mm/s a tick for
// what else moves it (a ball, another robot, a slope). A rim that leads it by more than 45 mm/s in the torque's
// direction spins. Each tick of that withholds another tenth of the torque limit, each other tick gives a 256th back.
// Where commands are late, the torque is the one that acts, a cut is a fifth, and the next one waits until this one acts.
// So the wheel works near the torque at which it spins, and finds it anew all the time: no friction need be known.
//
//   limit = slip.limit(robot, measured_mm_s);  torque = clamp(wanted, -limit, limit);  slip.acts(torque);
//
// Once a tick. Speeds within +-8000 mm/s; about thirty instructions, two of them multiplications.
#pragma once

#include <cstdint>

#include "firmware/core/robot_profile.hpp"

namespace striker::core {

class SlipLimiter {
 public:
  // The greatest torque for this tick, in mNm.
  [[nodiscard]] std::int32_t limit(const RobotProfile& robot, std::int32_t measured_mm_s);

  // What acts on the wheel in this tick.
  void acts(std::int32_t torque_mNm) { torque_mNm_ = torque_mNm; }
  [[nodiscard]] std::int32_t acting_mNm() const { return torque_mNm_; }

 private:
  // Whole words, all 0 at rest: they are part of the sealed state (seal.hpp).
  std::int32_t reference_q6_ = 0;    // mm/s
  std::int32_t withheld_q8_ = 0;     // of the torque limit
  std::int32_t torque_mNm_ = 0;      // that acts
  std::int32_t settling_ticks_ = 0;  // until the last cut acts
};

}  // namespace striker::core
