// SPDX-License-Identifier: Apache-2.0
// Wheel drives whose measured speeds are wrong: a decorator of any other. What they do with commands is right.
#pragma once

#include <cstdint>
#include <vector>

#include "sil/fault/plan/fault_plan.hpp"
#include "sil/robot/wheel_drives.hpp"

namespace striker::sil {

// One fault of the drives.
class DriveFault final : public WheelDrives {
 public:
  DriveFault(WheelDrives& drives, const TimedFault& fault) : drives_(&drives), fault_(fault) {}

  void take(const can::Frame& frame, std::uint32_t tick) override { drives_->take(frame, tick); }
  [[nodiscard]] bool cut(std::uint32_t tick) const override { return drives_->cut(tick); }
  [[nodiscard]] const WheelOrders& orders() const override { return drives_->orders(); }
  void report(const RimSpeeds& speeds, std::uint32_t tick, std::vector<can::Frame>& frames) override;

 private:
  [[nodiscard]] RimSpeeds changed(const RimSpeeds& honest, std::uint32_t tick) const;
  [[nodiscard]] double changed(double honest_m_s, std::uint32_t tick) const;

  WheelDrives* drives_;
  TimedFault fault_;
};

}  // namespace striker::sil
