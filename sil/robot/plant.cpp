// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/plant.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sil/world/robot_specs.hpp"

namespace striker::sil {

namespace {

class ServoPlant final : public Plant {
 public:
  ServoPlant(std::size_t robot, double torque_ceiling_Nm)
      : robot_(robot), torque_ceiling_Nm_(torque_ceiling_Nm) {}

  [[nodiscard]] std::uint32_t ticks_per_step() const override { return 10; }
  void reset() override { measured_ = {}; }

  void actuate(World& world, const WheelOrders& orders, bool cut) override {
    const double ceiling_Nm = cut ? 0.0 : torque_ceiling_Nm_;
    for (std::size_t i = 0; i < orders.size(); ++i) {
      world.servo_wheel(robot_, wheels[i], orders[i].rim_speed_m_s, ceiling_Nm);
    }
  }

  void sense(const World& world) override {
    measured_ = {world.rim_speed_m_s(robot_, Wheel::left), world.rim_speed_m_s(robot_, Wheel::right)};
  }

  [[nodiscard]] RimSpeeds measured() const override { return measured_; }

 private:
  std::size_t robot_;
  double torque_ceiling_Nm_;
  RimSpeeds measured_;
};

class DrivePlant final : public Plant {
 public:
  DrivePlant(std::size_t robot, const RobotSpec& spec)
      : robot_(robot),
        torque_ceiling_Nm_(spec.max_wheel_torque_Nm),
        count_m_(2.0 * std::numbers::pi * spec.wheel_radius_m / 16384.0) {}

  [[nodiscard]] std::uint32_t ticks_per_step() const override { return 1; }
  void reset() override { channels_ = {}; }

  void actuate(World& world, const WheelOrders& orders, bool cut) override {
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const double wanted_Nm =
          cut ? 0.0 : std::clamp(orders[i].torque_Nm, -torque_ceiling_Nm_, torque_ceiling_Nm_);
      channels_[i].torque_Nm += current_loop_gain * (wanted_Nm - channels_[i].torque_Nm);
      world.torque_wheel(robot_, wheels[i], channels_[i].torque_Nm);
    }
  }

  void sense(const World& world) override {
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      Channel& channel = channels_[i];
      channel.travel_m += world.rim_speed_m_s(robot_, wheels[i]) * step_s;
      const double counts = std::floor(channel.travel_m / count_m_);
      channel.speed_m_s = (counts - channel.counts) * count_m_ / step_s;
      channel.counts = counts;
    }
  }

  [[nodiscard]] RimSpeeds measured() const override {
    return {channels_[0].speed_m_s, channels_[1].speed_m_s};
  }

 private:
  struct Channel {
    double torque_Nm = 0.0;
    double travel_m = 0.0;  // of the rim
    double counts = 0.0;    // of the encoder, at the last measurement
    double speed_m_s = 0.0;
  };

  static constexpr double step_s = tick_s;
  static constexpr double current_loop_gain = 0.6321205588285577;  // 1 - exp(-1 ms / 1 ms)

  std::size_t robot_;
  double torque_ceiling_Nm_;
  double count_m_;  // of the rim, for one of the encoder
  std::array<Channel, 2> channels_;
};

}  // namespace

std::optional<PlantKind> plant_kind_of(std::string_view name) {
  const auto* const found = std::find_if(plant_kinds.begin(), plant_kinds.end(),
                                         [&](PlantKind kind) { return name_of(kind) == name; });
  return found == plant_kinds.end() ? std::nullopt : std::optional(*found);
}

std::unique_ptr<Plant> make_plant(PlantKind kind, std::size_t robot, const RobotSpec& spec) {
  if (kind == PlantKind::servo) {
    return std::make_unique<ServoPlant>(robot, spec.max_wheel_torque_Nm);
  }
  return std::make_unique<DrivePlant>(robot, spec);
}

}  // namespace striker::sil
