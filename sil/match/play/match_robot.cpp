// SPDX-License-Identifier: Apache-2.0
#include "sil/match/play/match_robot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware/can/messages.hpp"
#include "sil/fault/live_faults.hpp"
#include "sil/match/record/statistics/match_figures.hpp"

namespace striker::sil {

static_assert(status_period_ms == can::layout<can::Status>.info.period_ms);

MatchRobot::MatchRobot(std::size_t robot, const core::RobotDescription& description,
                       std::unique_ptr<Plant> plant, ControllerLink& link, const RobotFaults& faults)
    : torque_limit_Nm_(description.torque_limit_mNm / 1e3), plant_(std::move(plant)), camera_(robot) {
  if (faults.faults.empty()) {
    seat_ = &sound_seat_.emplace(
        SeatParts{.robot = robot, .plant = *plant_, .drives = drives_, .camera = camera_, .link = link});
    return;
  }
  faulty_seat_ = std::make_unique<FaultySeat>(SoundParts{.robot = robot,
                                                         .plant = *plant_,
                                                         .drives = drives_,
                                                         .camera = camera_,
                                                         .link = link,
                                                         .controller = controller_behind(link)},
                                              faults.faults, faults.seed);
  seat_ = &faulty_seat_->seat();
}

void MatchRobot::was_placed() {
  operator_.was_placed();
  seat_->reset();
}

void MatchRobot::sees(const World& world, std::uint32_t tick) {
  operator_.sees_picture();
  seat_->take_picture(world, tick);
}

void MatchRobot::is_told(const RobotOrder& order, std::uint32_t tick) {
  last_order_ = order;
  say(order, tick);
}

void MatchRobot::say(const RobotOrder& order, std::uint32_t tick) {
  seat_->queue(team_.frame(order));
  last_order_tick_ = tick;
}

void MatchRobot::begin_tick(std::uint32_t tick) {
  if (const auto command = operator_.speak()) {
    seat_->queue(*command);
  }
  if (operator_.has_just_armed() && last_order_ && last_order_tick_ != tick) {
    say(*last_order_, tick);
  }
  seat_->begin_tick(tick);
}

void MatchRobot::end_tick(std::uint32_t tick) {
  seat_->end_tick(tick);
  if (faulty_seat_) {
    faulty_seat_->clock().end_tick({.tick = tick, .robots = {}, .ball = {}});
    lost_frames_ += faulty_seat_->frames_not_through();
  }
  const std::uint64_t statuses = operator_.heard().statuses();
  operator_.hear(seat_->answer());
  status_tick_ = operator_.heard().statuses() != statuses ? tick : status_tick_;
  const auto is_at_limit = [this](const WheelOrder& wheel) {
    return std::abs(wheel.torque_Nm) >= torque_limit_Nm_;
  };
  saturated_ticks_ += std::ranges::any_of(drives_.orders(), is_at_limit) ? 1 : 0;
}

RobotRecord MatchRobot::take_record(const World& world, std::uint32_t tick) {
  const RimSpeeds rim = plant_->measured();
  const WheelOrders& orders = drives_.orders();
  const double up = world.robot_up(seat_->robot());
  return {
      .velocity_m_s = world.robot_velocity_m_s(seat_->robot()),
      .turn_rate_rad_s = world.yaw_rate_rad_s(seat_->robot()),
      .rim_speeds_m_s = {rim.left_m_s, rim.right_m_s},
      .set_points_m_s = {orders[0].rim_speed_m_s, orders[1].rim_speed_m_s},
      .up = up,
      .height_m = world.robot_height_m(seat_->robot()) + up * (standing_height_m - centre_of_mass_height_m),
      .state = operator_.heard().controller_state(),
      .fault = operator_.heard().controller_fault(),
      .status_age_ms = static_cast<int>(tick - status_tick_),
      .order_age_ms =
          last_order_tick_ ? std::optional(static_cast<int>(tick - *last_order_tick_)) : std::nullopt,
      .lost_frames = std::exchange(lost_frames_, 0),
      .saturated_ticks = std::exchange(saturated_ticks_, 0)};
}

}  // namespace striker::sil
