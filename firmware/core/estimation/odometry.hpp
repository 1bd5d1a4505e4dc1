// SPDX-License-Identifier: Apache-2.0
// What the wheels say of the robot's motion since the last picture was taken: a speed in mm/s times a tick of 1 ms is
// a distance in um.
//
// A picture comes when the robot has moved on. So the way is marked at the ticks at which pictures are expected to be
// taken, a period apart; the last marks are kept, and the one nearest to when a picture was taken tells how far the
// robot had come. That serves the latencies of every described camera with the exact way, and any jitter of a few ms by
// the speed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/percepts.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/tick.hpp"

namespace striker::core {

// Far beyond the limit of freshness; it keeps every product within 32 bits.
inline constexpr std::uint32_t greatest_led_ticks = 1000;
static_assert(greatest_led_ticks > vision_timeout_ticks);

// From when a picture was taken until it came with the greatest latency, both included.
inline constexpr std::size_t kept_marks =
    static_cast<std::size_t>(greatest_delay_ticks * tick_us / least_picture_period_us) + 1;

// Along the path, and the right rim ahead of the left.
struct Way {
  std::int32_t travelled_um = 0;
  std::int32_t turned_um = 0;
};

class Odometry {
 public:
  void take(const WheelSpeeds& wheels) {
    speed_mm_s_ = (wheels.left_mm_s + wheels.right_mm_s) / 2;
    turn_mm_s_ = wheels.right_mm_s - wheels.left_mm_s;
  }

  // To `tick`, with the last speeds; once a tick.
  void advance(const RobotProfile& robot, std::uint32_t tick) {
    const std::uint32_t passed = std::min(tick - tick_, greatest_led_ticks);
    tick_ = tick;
    led_ticks_ += passed;
    if (led_ticks_ <= greatest_led_ticks) {
      travelled_um_ += speed_mm_s_ * static_cast<std::int32_t>(passed);
      turned_um_ += turn_mm_s_ * static_cast<std::int32_t>(passed);
    } else {
      led_ticks_ = greatest_led_ticks + 1;
    }
    if (tick - next_mark_tick_ < passed) {
      std::copy(marks_.begin() + 1, marks_.end(), marks_.begin());
      marks_.back() = {next_mark_tick_, by_speed({travelled_um_, turned_um_},
                                                 static_cast<std::int32_t>(next_mark_tick_ - tick))};
      next_mark_tick_ += mark_ticks(robot);
    }
  }

  // The way until this tick, which is past or now.
  [[nodiscard]] Way until(std::uint32_t tick) const {
    std::uint32_t apart_ticks = tick_ - tick;
    Way way = by_speed({travelled_um_, turned_um_},
                       -static_cast<std::int32_t>(std::min(apart_ticks, greatest_led_ticks)));
    for (const Mark& mark : marks_) {
      const std::uint32_t from_mark_ticks = std::min(tick - mark.tick, mark.tick - tick);
      if (from_mark_ticks < apart_ticks && from_mark_ticks < decision_period_ticks / 2) {
        apart_ticks = from_mark_ticks;
        way = by_speed(mark.way, static_cast<std::int32_t>(tick - mark.tick));
      }
    }
    return way;
  }

  // Counts the way from this tick on, when a picture was taken.
  void restart(const RobotProfile& robot, std::uint32_t tick) {
    const Way past = until(tick);
    for (Mark& mark : marks_) {
      mark.way.travelled_um -= past.travelled_um;
      mark.way.turned_um -= past.turned_um;
    }
    travelled_um_ -= past.travelled_um;
    turned_um_ -= past.turned_um;
    led_ticks_ = std::min(tick_ - tick, greatest_led_ticks);
    next_mark_tick_ = tick_ + mark_ticks(robot) - led_ticks_ % mark_ticks(robot);
  }

  [[nodiscard]] std::int32_t speed_mm_s() const { return speed_mm_s_; }      // along the heading
  [[nodiscard]] std::int32_t travelled_um() const { return travelled_um_; }  // along the path

 private:
  struct Mark {
    std::uint32_t tick = 0;
    Way way;
  };

  // Half a ms off at most, and begun anew with every picture.
  static std::uint32_t mark_ticks(const RobotProfile& robot) {
    return static_cast<std::uint32_t>(robot.picture_period_us + tick_us / 2) / tick_us;
  }

  [[nodiscard]] Way by_speed(const Way& way, std::int32_t ticks) const {
    return {way.travelled_um + speed_mm_s_ * ticks, way.turned_um + turn_mm_s_ * ticks};
  }

  std::int32_t travelled_um_ = 0;
  std::int32_t turned_um_ = 0;
  std::uint32_t led_ticks_ = 0;  // since the last picture; stays beyond the greatest
  std::uint32_t tick_ = 0;
  std::int32_t speed_mm_s_ = 0;
  std::int32_t turn_mm_s_ = 0;
  std::uint32_t next_mark_tick_ = 0;
  std::array<Mark, kept_marks> marks_{};  // the newest last
};

}  // namespace striker::core
