// The wheel-speed loops: a PI controller for each wheel, 1 kHz, from rim speed to torque, with a torque limit
// and anti-windup by conditional integration.
//
// Gains: both wheels at torque T accelerate a forward robot by 2 T / (r m) = 27.8 mm/s^2 for each mNm
// (r = 0.04 m, m = 1.8 kg with the wheels' inertia), so kp = 3.6 mNm/(mm/s) crosses over near 100 rad/s,
// a decade below the 3 ms that measurement, tick and current loop delay; ki = kp * 10 rad/s.
#pragma once

#include <cstdint>

namespace striker::core {

inline constexpr std::int32_t torque_limit_mNm = 400;  // a forward robot's motor (AI World Cup)
inline constexpr std::int32_t top_rim_speed_mm_s = 2550;

class WheelLoop {
 public:
  void reset() { integral_q16_ = 0; }

  // The torque for this tick, in mNm, within +-torque_limit_mNm. Speeds within +-8000 mm/s.
  [[nodiscard]] std::int32_t step(std::int32_t set_point_mm_s, std::int32_t measured_mm_s);

 private:
  std::int32_t integral_q16_ = 0;  // mNm in Q16
};

}  // namespace striker::core
