// The two plants behind one interface: what turns a wheel command into motion, and what it measures.
//
// servo: the paper's motor. The set-point acts at the next physics step of 10 ms, within the torque ceiling.
// drive: a torque drive. Steps of 1 ms; the current loop follows the torque command with a first-order lag of
//        1 ms; rim speeds are measured by a 14-bit encoder over 1 ms (15.3 mm/s a count), as magnetic
//        encoders on small smart actuators do.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "firmware/can/messages.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

enum class PlantKind { servo, drive };

[[nodiscard]] std::string name_of(PlantKind kind);

struct RimSpeeds {
  double left_m_s = 0.0;
  double right_m_s = 0.0;
};

// One robot's drives. Every `ticks_per_step` ticks the caller calls `actuate`, steps the world by that time,
// and calls `sense`.
class Plant {
 public:
  virtual ~Plant() = default;
  [[nodiscard]] virtual std::uint32_t ticks_per_step() const = 0;
  // The robot was placed, at rest: forget currents and encoder angles.
  virtual void reset() = 0;
  // `cut`: the drives' watchdog holds the torque at 0, whatever the command says.
  virtual void actuate(World& world, const can::WheelCommand& command, bool cut) = 0;
  virtual void sense(const World& world) = 0;
  [[nodiscard]] virtual RimSpeeds measured() const = 0;
};

[[nodiscard]] std::unique_ptr<Plant> make_plant(PlantKind kind, std::size_t robot);

}  // namespace striker::sil
