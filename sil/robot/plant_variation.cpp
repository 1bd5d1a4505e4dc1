// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/plant_variation.hpp"

namespace striker::sil {

void ScaledPlant::actuate(World& world, const WheelOrders& orders, bool cut) {
  WheelOrders given = orders;
  for (WheelOrder& order : given) {
    order.torque_Nm *= torque_scale_;
  }
  plant_->actuate(world, given, cut);
}

void LatePlant::reset() {
  waiting_.clear();
  plant_->reset();
}

void LatePlant::actuate(World& world, const WheelOrders& orders, bool cut) {
  WheelOrders acting{};
  waiting_.push_back(orders);
  if (waiting_.size() > delay_steps_) {
    acting = waiting_.front();
    waiting_.pop_front();
  }
  plant_->actuate(world, acting, cut);
}

}  // namespace striker::sil
