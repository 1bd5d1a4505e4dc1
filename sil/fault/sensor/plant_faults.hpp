// SPDX-License-Identifier: Apache-2.0
// Motors that do not do what they are told: a decorator of any other plant.
#pragma once

#include <array>
#include <cstdint>

#include "sil/fault/plan/fault_plan.hpp"
#include "sil/robot/plant.hpp"

namespace striker::sil {

// One fault of the plant. `now` is the tick of the next step, kept by whoever moves time.
class PlantFault final : public Plant {
 public:
  PlantFault(Plant& plant, std::size_t robot, const TimedFault& fault, const std::uint32_t& now)
      : plant_(&plant), robot_(robot), fault_(fault), now_(&now) {}

  [[nodiscard]] std::uint32_t ticks_per_step() const override { return plant_->ticks_per_step(); }
  void reset() override;
  void actuate(World& world, const WheelOrders& orders, bool cut) override;
  void sense(const World& world) override { plant_->sense(world); }
  [[nodiscard]] RimSpeeds measured() const override;

 private:
  [[nodiscard]] bool concerns(std::size_t wheel) const;
  void spin(const WheelOrders& orders, bool cut);

  Plant* plant_;
  std::size_t robot_;
  TimedFault fault_;
  const std::uint32_t* now_;
  std::array<double, 2> slip_m_s_{};  // of the rim over the floor
};

}  // namespace striker::sil
