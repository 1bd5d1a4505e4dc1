// SPDX-License-Identifier: Apache-2.0
// What pictures and wheels cannot be, by themselves and against each other.
//
// The limits are physics with room to spare, so that no honest run comes near (tests/core/plausibility_test.cpp and
// the fault catalogue of striker-sil): they catch what froze, jumped, was reversed or scaled.
#pragma once

#include <cstdint>

#include "firmware/core/actions.hpp"
#include "firmware/core/estimation/odometry.hpp"
#include "firmware/core/estimation/picture.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/tick.hpp"

namespace striker::core {

// A ball that a robot has kicked does at most twice the robot's top speed; beyond this nothing rolls.
inline constexpr std::int32_t greatest_ball_speed_mm_s = 12'000;
inline constexpr std::int32_t greatest_jump_um = 50'000;  // beyond what the speed explains

// The camera's numbers against the time. A picture may be earlier or later than its number says by less than a period,
// and the next one makes up for it. A camera of another rate than described adds up: one that is faster or slower by
// more than 5.5 % ends beyond twice that. Sealed: whole words.
class PictureTiming {
 public:
  // So many numbers and ticks after the last picture that was taken.
  [[nodiscard]] bool fits(const RobotProfile& robot, std::int32_t pictures,
                          std::uint32_t elapsed_ticks) const;
  // That one was taken.
  void take(const RobotProfile& robot, std::int32_t pictures, std::uint32_t elapsed_ticks);

 private:
  std::int32_t late_us_ = 0;  // summed, and slowly forgotten: a rate is never exact
};

// Robot and ball could have moved from one picture to the next.
[[nodiscard]] bool is_possible(const RobotProfile& robot, const Picture& from, const Picture& to,
                               std::int32_t pictures);

// The robot moved and turned as its wheels did on this way, which they rolled evenly: of a robot that turned to and fro
// between two pictures by more than a quarter of a turn the way is not known.
[[nodiscard]] bool wheels_agree(const RobotProfile& robot, const Picture& from, const Picture& to,
                                const Way& rolled);

// Each wheel against its own past and against its torque. Sealed: whole words.
class WheelPlausibility {
 public:
  void restart() { *this = {}; }

  // Once for every measurement while armed, with the torque that acted before it. False if it cannot be.
  bool possible(const RobotProfile& robot, std::uint32_t tick, const WheelSpeeds& measured,
                const WheelTorques& torque);

 private:
  struct Wheel {
    std::int32_t before_mm_s = 0;
    std::int32_t window_begin_mm_s = 0;
    std::int32_t torque_sum_mNm = 0;  // over the window
    std::int32_t against = 0;         // windows in a row that went against the torque
  };

  static bool follows(const RobotProfile& robot, Wheel& wheel, std::int32_t measured_mm_s);

  Wheel left_;
  Wheel right_;
  std::uint32_t begun_ = 0;
  std::uint32_t tick_ = 0;
  std::uint32_t in_window_ = 0;
  std::uint32_t jump_ticks_ = 0;   // of the last jumps, that are still held against it
  std::int32_t beyond_ticks_ = 0;  // that a wheel has been faster than any
};

}  // namespace striker::core
