// SPDX-License-Identifier: Apache-2.0
// Motors that differ from their data sheet: decorators of any other plant, which outlives them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "sil/robot/plant.hpp"

namespace striker::sil {

// They give more or less torque than they are told to, all the time: another robot's mass, in effect. A servo
// follows its set-point all the same.
class ScaledPlant final : public Plant {
 public:
  ScaledPlant(Plant& plant, double torque_scale) : plant_(&plant), torque_scale_(torque_scale) {}

  [[nodiscard]] std::uint32_t ticks_per_step() const override { return plant_->ticks_per_step(); }
  void reset() override { plant_->reset(); }
  void actuate(World& world, const WheelOrders& orders, bool cut) override;
  void sense(const World& world) override { plant_->sense(world); }
  [[nodiscard]] RimSpeeds measured() const override { return plant_->measured(); }

 private:
  Plant* plant_;
  double torque_scale_;
};

// They act on what they were told some time ago, in whole steps of theirs; nothing before that. The drives' time-out
// acts at once.
class LatePlant final : public Plant {
 public:
  LatePlant(Plant& plant, std::uint32_t delay_ms)
      : plant_(&plant), delay_steps_(delay_ms / plant.ticks_per_step()) {}

  [[nodiscard]] std::uint32_t ticks_per_step() const override { return plant_->ticks_per_step(); }
  void reset() override;
  void actuate(World& world, const WheelOrders& orders, bool cut) override;
  void sense(const World& world) override { plant_->sense(world); }
  [[nodiscard]] RimSpeeds measured() const override { return plant_->measured(); }

 private:
  Plant* plant_;
  std::size_t delay_steps_;
  std::deque<WheelOrders> waiting_;
};

}  // namespace striker::sil
