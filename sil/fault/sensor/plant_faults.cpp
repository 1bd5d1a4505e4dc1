// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/sensor/plant_faults.hpp"

#include <algorithm>

namespace striker::sil {

namespace {

// More than any motor here: holds a wheel against its own.
constexpr double brake_Nm = 2.0;

// A rim without grip spins up ten times as fast as the robot does at full grip (27.8 m/s^2 for a N m), and is braked
// by what grip it has within some 20 ms.
constexpr double spin_m_s2_Nm = 278.0;
constexpr double spin_time_s = 0.020;

WheelOrder scaled(const WheelOrder& order, double factor) {
  return {.torque_Nm = factor * order.torque_Nm, .rim_speed_m_s = factor * order.rim_speed_m_s};
}

}  // namespace

void PlantFault::reset() {
  slip_m_s_ = {};
  plant_->reset();
}

void PlantFault::actuate(World& world, const WheelOrders& orders, bool cut) {
  const bool lasts = fault_.lasts(*now_);
  WheelOrders given = orders;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const bool weakened =
        fault_.fault.kind == FaultKind::torque_saturated || fault_.fault.kind == FaultKind::wheel_slips;
    if (lasts && weakened && concerns(i)) {
      given[i] = scaled(orders[i], fault_.fault.value);
    }
  }
  spin(orders, cut || !lasts);
  plant_->actuate(world, given, cut);
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (lasts && fault_.fault.kind == FaultKind::wheel_stuck && concerns(i)) {
      world.servo_wheel(robot_, wheels[i], 0.0, brake_Nm);
    }
  }
}

RimSpeeds PlantFault::measured() const {
  const RimSpeeds rolling = plant_->measured();
  return {.left_m_s = rolling.left_m_s + slip_m_s_[0], .right_m_s = rolling.right_m_s + slip_m_s_[1]};
}

bool PlantFault::concerns(std::size_t wheel) const {
  return fault_.fault.wheel == FaultyWheel::both ||
         wheel ==
             static_cast<std::size_t>(fault_.fault.wheel == FaultyWheel::left ? Wheel::left : Wheel::right);
}

void PlantFault::spin(const WheelOrders& orders, bool free) {
  const double step_s = plant_->ticks_per_step() * tick_s;
  for (std::size_t i = 0; i < slip_m_s_.size(); ++i) {
    const bool slips = fault_.fault.kind == FaultKind::wheel_slips && concerns(i) && !free;
    const double lost_Nm = slips ? (1.0 - fault_.fault.value) * orders[i].torque_Nm : 0.0;
    slip_m_s_[i] += step_s * spin_m_s2_Nm * lost_Nm - std::min(1.0, step_s / spin_time_s) * slip_m_s_[i];
  }
}

}  // namespace striker::sil
