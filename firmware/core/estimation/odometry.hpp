// SPDX-License-Identifier: Apache-2.0
// What the wheels say of the robot's motion since the last picture: a speed in mm/s times a tick of 1 ms is a
// distance in um.
#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/core/percepts.hpp"

namespace striker::core {

// Far beyond the limit of freshness; it keeps every product within 32 bits.
inline constexpr std::uint32_t greatest_led_ticks = 1000;
static_assert(greatest_led_ticks > vision_timeout_ticks);

class Odometry {
 public:
  void take(const WheelSpeeds& wheels) {
    speed_mm_s_ = (wheels.left_mm_s + wheels.right_mm_s) / 2;
    turn_mm_s_ = wheels.right_mm_s - wheels.left_mm_s;
  }

  // To `tick`, with the last speeds; once a tick.
  void advance(std::uint32_t tick) {
    const std::uint32_t passed = std::min(tick - tick_, greatest_led_ticks);
    tick_ = tick;
    led_ticks_ += passed;
    if (led_ticks_ <= greatest_led_ticks) {
      travelled_um_ += speed_mm_s_ * static_cast<std::int32_t>(passed);
      turned_um_ += turn_mm_s_ * static_cast<std::int32_t>(passed);
    } else {
      led_ticks_ = greatest_led_ticks + 1;
    }
  }

  // A picture that came `age_ticks` ago: what was travelled since then is kept, by the last speed.
  void restart(std::uint32_t age_ticks) {
    led_ticks_ = age_ticks;
    travelled_um_ = speed_mm_s_ * static_cast<std::int32_t>(age_ticks);
    turned_um_ = turn_mm_s_ * static_cast<std::int32_t>(age_ticks);
  }

  [[nodiscard]] std::int32_t speed_mm_s() const { return speed_mm_s_; }      // along the heading
  [[nodiscard]] std::int32_t travelled_um() const { return travelled_um_; }  // along the path
  [[nodiscard]] std::int32_t turned_um() const { return turned_um_; }  // the right rim ahead of the left

 private:
  std::int32_t travelled_um_ = 0;
  std::int32_t turned_um_ = 0;
  std::uint32_t led_ticks_ = 0;  // since the last picture; stays beyond the greatest
  std::uint32_t tick_ = 0;
  std::int32_t speed_mm_s_ = 0;
  std::int32_t turn_mm_s_ = 0;
};

}  // namespace striker::core
