// SPDX-License-Identifier: Apache-2.0
// Motors whose wheels slip by chance, as AI Soccer's do: every physics step each wheel is driven by up to a share more
// or less than it was told. A decorator of any other plant.
#pragma once

#include <memory>
#include <utility>

#include "sil/robot/plant.hpp"
#include "sil/world/random.hpp"

namespace striker::sil {

class SlipPlant final : public Plant {
 public:
  // `slip`: the share, from 0 to 1. Draws two numbers a step.
  SlipPlant(std::unique_ptr<Plant> plant, double slip, const Random& random)
      : plant_(std::move(plant)), slip_(slip), random_(random) {}

  [[nodiscard]] std::uint32_t ticks_per_step() const override { return plant_->ticks_per_step(); }
  void reset() override { plant_->reset(); }
  void actuate(World& world, const WheelOrders& orders, bool cut) override {
    WheelOrders slipped = orders;
    for (WheelOrder& wheel : slipped) {
      const double share = 1.0 + random_.uniform(-slip_, slip_);
      wheel.torque_Nm *= share;
      wheel.rim_speed_m_s *= share;
    }
    plant_->actuate(world, slipped, cut);
  }
  void sense(const World& world) override { plant_->sense(world); }
  [[nodiscard]] RimSpeeds measured() const override { return plant_->measured(); }

 private:
  std::unique_ptr<Plant> plant_;
  double slip_;
  Random random_;
};

}  // namespace striker::sil
