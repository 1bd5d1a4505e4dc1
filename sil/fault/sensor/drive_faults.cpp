// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/sensor/drive_faults.hpp"

#include <cmath>

#include "sil/fault/link/recode.hpp"

namespace striker::sil {

void DriveFault::report(const RimSpeeds& speeds, std::uint32_t tick, std::vector<can::Frame>& frames) {
  if (!fault_.lasts(tick)) {
    drives_->report(speeds, tick, frames);
    return;
  }
  const std::size_t before = frames.size();
  drives_->report(changed(speeds, tick), tick, frames);
  for (std::size_t i = before; fault_.fault.kind == FaultKind::torque_cut_told && i < frames.size(); ++i) {
    if (auto state = read<can::WheelState>(frames[i])) {
      state->torque_cut = 1;
      frames[i] = with_counter_of(frames[i], *state);
    }
  }
}

RimSpeeds DriveFault::changed(const RimSpeeds& honest, std::uint32_t tick) const {
  if (fault_.fault.kind == FaultKind::wheels_swapped) {
    return {.left_m_s = honest.right_m_s, .right_m_s = honest.left_m_s};
  }
  RimSpeeds told = honest;
  if (fault_.fault.wheel != FaultyWheel::right) {
    told.left_m_s = changed(honest.left_m_s, tick);
  }
  if (fault_.fault.wheel != FaultyWheel::left) {
    told.right_m_s = changed(honest.right_m_s, tick);
  }
  return told;
}

double DriveFault::changed(double honest_m_s, std::uint32_t tick) const {
  const double value = fault_.fault.value;
  switch (fault_.fault.kind) {
    case FaultKind::wheels_frozen:
      return value * 1e-3;
    case FaultKind::wheels_reversed:
      return -honest_m_s;
    case FaultKind::wheels_scaled:
      return value * honest_m_s;
    case FaultKind::wheels_wrapped:
      return std::remainder(honest_m_s, 2.0 * value * 1e-3);
    case FaultKind::wheels_jump:
      return (tick % 2 == 0 ? value : -value) * 1e-3;
    default:
      return honest_m_s;
  }
}

}  // namespace striker::sil
