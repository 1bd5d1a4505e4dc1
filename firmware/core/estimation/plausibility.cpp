// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/estimation/plausibility.hpp"

#include <algorithm>

#include "firmware/core/estimation/magnitude.hpp"

namespace striker::core {

namespace {

constexpr bool beyond(const Vector& from, const Vector& to, std::int32_t limit_um) {
  return magnitude(to.x - from.x) > limit_um || magnitude(to.y - from.y) > limit_um;
}

// The wheels may slip, and the robot may be pushed, by this much between two pictures, and by a quarter of the way.
constexpr std::int32_t slip_um = 45'000;
constexpr std::int32_t slip_angle = 65536 / 16;
constexpr std::int32_t half_turn = 65536 / 2;

// Twice as far as any wheels turn a robot in the time between two pictures; with the narrowest axle's gain, 1,068, it stays
// within 32 bits.
constexpr std::int32_t greatest_turned_um = 2'000'000;

// A rim gains 0.2 m/s in a tick if its wheel is free in the air. One that lands, having spun up or been braked there,
// changes by more at once; but it does not land again and again: each jump counts for 16 ticks, and two are forgiven.
constexpr std::int32_t greatest_change_mm_s = 1'000;
constexpr std::uint32_t jump_hold_ticks = 16;
constexpr std::uint32_t jump_limit_ticks = 2 * jump_hold_ticks;

constexpr std::uint32_t window_ticks = 16;
constexpr std::int32_t windows_against = 3;

constexpr std::int32_t kept_pictures = 32;  // of the sum of their lateness

constexpr std::int32_t lateness_us(const RobotProfile& robot, std::int32_t pictures,
                                   std::uint32_t elapsed_ticks) {
  return static_cast<std::int32_t>(elapsed_ticks) * tick_us - pictures * robot.picture_period_us;
}

}  // namespace

bool PictureTiming::fits(const RobotProfile& robot, std::int32_t pictures,
                         std::uint32_t elapsed_ticks) const {
  const std::int32_t late_us = lateness_us(robot, pictures, elapsed_ticks);
  const std::int32_t tolerance_us = robot.picture_period_us / 10 * 9;
  return magnitude(late_us) <= tolerance_us && magnitude(late_us_ + late_us) <= 2 * tolerance_us;
}

void PictureTiming::take(const RobotProfile& robot, std::int32_t pictures, std::uint32_t elapsed_ticks) {
  late_us_ += lateness_us(robot, pictures, elapsed_ticks) - late_us_ / kept_pictures;
}

bool is_possible(const RobotProfile& robot, const Picture& from, const Picture& to, std::int32_t pictures) {
  const std::int32_t elapsed_ms = pictures * robot.picture_period_us / 1'000;
  return !beyond(from.robot_um, to.robot_um, robot.overspeed_mm_s * elapsed_ms + greatest_jump_um) &&
         !beyond(from.ball_um, to.ball_um, greatest_ball_speed_mm_s * elapsed_ms + greatest_jump_um);
}

// On an arc the way goes along the mean heading, and a curved one is shorter than what the wheels rolled. One wheel alone that
// is a tenth larger turns a robot by a tenth of its way. Which way round a robot went that may have turned by half a turn
// is not seen: then the way is known by its length alone.
bool wheels_agree(const RobotProfile& robot, const Picture& from, const Picture& to, const Way& rolled) {
  const auto turn_of = [&robot](std::int32_t rims_um) {
    return std::clamp(rims_um, -greatest_turned_um, greatest_turned_um) * robot.turn_q12 / 4096;
  };
  const BinaryAngle turned = wrap_angle(to.heading - from.heading);
  const std::int32_t rolled_turn = turn_of(rolled.turned_um);
  const std::int32_t way_um = magnitude(rolled.travelled_um);
  const std::int32_t turn_slip = slip_angle + (magnitude(rolled_turn) + turn_of(way_um) / 2) / 4;
  if (magnitude(wrap_angle(turned - wrap_angle(rolled_turn))) > turn_slip) {
    return false;
  }
  const Vector moved = {to.robot_um.x - from.robot_um.x, to.robot_um.y - from.robot_um.y};
  if (magnitude(rolled_turn) + turn_slip > half_turn) {
    return !beyond(moved, {}, slip_um + way_um + way_um / 4);
  }
  const Vector expected = rotate({rolled.travelled_um, 0}, wrap_angle(from.heading + turned / 2));
  return !beyond(moved, expected, slip_um + way_um / 4);
}

bool WheelPlausibility::follows(const RobotProfile& robot, Wheel& wheel, std::int32_t measured_mm_s) {
  // Half of what the sum of the torque should have gained is too much against it. In steps of torque, as loops_fit() has
  // it, 50 of the greatest gain stay within 32 bits, and a window is 35 ticks at most.
  const std::int32_t gained_mm_s = measured_mm_s - wheel.window_begin_mm_s;
  const std::int32_t torque_sum = magnitude(wheel.torque_sum_mNm);
  const bool strong = torque_sum > robot.torque_limit_mNm * static_cast<std::int32_t>(window_ticks) / 2;
  const bool against = (wheel.torque_sum_mNm > 0) != (gained_mm_s > 0) &&
                       magnitude(gained_mm_s) * 8'192 >
                           torque_sum * torque_steps / robot.torque_limit_mNm * robot.pending_gain_q12;
  wheel.against = strong && against ? wheel.against + 1 : 0;
  wheel.torque_sum_mNm = 0;
  wheel.window_begin_mm_s = measured_mm_s;
  return wheel.against < windows_against;
}

bool WheelPlausibility::possible(const RobotProfile& robot, std::uint32_t tick, const WheelSpeeds& measured,
                                 const WheelTorques& torque) {
  const auto elapsed = static_cast<std::int32_t>(std::min(tick - tick_, wheel_timeout_ticks));
  const bool jumped =
      begun_ != 0 && (magnitude(measured.left_mm_s - left_.before_mm_s) > greatest_change_mm_s * elapsed ||
                      magnitude(measured.right_mm_s - right_.before_mm_s) > greatest_change_mm_s * elapsed);
  jump_ticks_ -= std::min(jump_ticks_, static_cast<std::uint32_t>(elapsed));
  jump_ticks_ += jumped ? jump_hold_ticks : 0;
  const bool jumps_on = jump_ticks_ > jump_limit_ticks;
  jump_ticks_ = std::min(jump_ticks_, 2 * jump_limit_ticks);
  const std::int32_t greatest_mm_s = 2 * robot.top_rim_speed_mm_s;
  const bool beyond_any =
      magnitude(measured.left_mm_s) > greatest_mm_s || magnitude(measured.right_mm_s) > greatest_mm_s;
  beyond_ticks_ = std::max<std::int32_t>(0, beyond_ticks_ + (beyond_any ? elapsed : -elapsed));
  // A wheel that is free at the contact with the ball gets the torque that is on its way, and needs as long to come back.
  const bool runs_away = beyond_ticks_ > 2 * robot.command_delay_ticks;
  if (begun_ == 0) {
    left_.window_begin_mm_s = measured.left_mm_s;
    right_.window_begin_mm_s = measured.right_mm_s;
  }
  begun_ = 1;
  tick_ = tick;
  left_.before_mm_s = measured.left_mm_s;
  right_.before_mm_s = measured.right_mm_s;
  left_.torque_sum_mNm += torque.left_mNm * elapsed;
  right_.torque_sum_mNm += torque.right_mNm * elapsed;
  in_window_ += static_cast<std::uint32_t>(elapsed);
  if (in_window_ < window_ticks) {
    return !jumps_on && !runs_away;
  }
  in_window_ = 0;
  const bool left_follows = follows(robot, left_, measured.left_mm_s);
  return follows(robot, right_, measured.right_mm_s) && left_follows && !jumps_on && !runs_away;
}

}  // namespace striker::core
