// SPDX-License-Identifier: Apache-2.0
// The two plants behind one interface: what turns the drives' orders into motion, and what it measures. SI
// units; nothing here knows a frame.
//
// servo: the paper's motor. The set-point acts at the next physics step of 10 ms, within the torque ceiling.
// drive: a torque drive. Steps of 1 ms; the current loop follows the torque order with a first-order lag of
//        1 ms; rim speeds are measured by a 14-bit encoder over 1 ms (15.3 mm/s a count), as magnetic
//        encoders on small smart actuators do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "firmware/core/tick.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

inline constexpr double tick_s = core::tick_us / 1e6;

enum class PlantKind { servo, drive };

inline constexpr std::array plant_kinds = {PlantKind::servo, PlantKind::drive};

[[nodiscard]] constexpr std::string_view name_of(PlantKind kind) {
  return kind == PlantKind::servo ? "servo" : "drive";
}

// The kind with this name, or nothing.
[[nodiscard]] std::optional<PlantKind> plant_kind_of(std::string_view name);

// What one wheel is told: a torque drive follows the torque, a servo the set-point.
struct WheelOrder {
  double torque_Nm = 0.0;
  double rim_speed_m_s = 0.0;
};
using WheelOrders = std::array<WheelOrder, 2>;  // in the order of Wheel

struct RimSpeeds {
  double left_m_s = 0.0;
  double right_m_s = 0.0;
};

// One robot's motors. Every `ticks_per_step` ticks the caller calls `actuate`, steps the world by that time,
// and calls `sense`.
class Plant {
 public:
  virtual ~Plant() = default;
  [[nodiscard]] virtual std::uint32_t ticks_per_step() const = 0;
  // The robot was placed, at rest: forget currents and encoder angles.
  virtual void reset() = 0;
  // `cut`: the drives' watchdog holds the torque at 0, whatever the orders say.
  virtual void actuate(World& world, const WheelOrders& orders, bool cut) = 0;
  virtual void sense(const World& world) = 0;
  [[nodiscard]] virtual RimSpeeds measured() const = 0;
};

// For robot number `robot` of the world, with the wheels and the torque ceiling of this one.
[[nodiscard]] std::unique_ptr<Plant> make_plant(PlantKind kind, std::size_t robot, const RobotSpec& spec);

}  // namespace striker::sil
