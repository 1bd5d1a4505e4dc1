#include "sil/robot/plant.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sil/world/robot_specs.hpp"

namespace striker::sil {

namespace {

constexpr std::array wheels = {Wheel::left, Wheel::right};

constexpr double torque_ceiling_Nm = robot_spec(Role::forward).max_wheel_torque_Nm;

class ServoPlant final : public Plant {
 public:
  explicit ServoPlant(std::size_t robot) : robot_(robot) {}

  [[nodiscard]] std::uint32_t ticks_per_step() const override { return 10; }
  void reset() override { measured_ = {}; }

  void actuate(World& world, const can::WheelCommand& command, bool cut) override {
    const double ceiling_Nm = cut ? 0.0 : torque_ceiling_Nm;
    world.servo_wheel(robot_, Wheel::left, command.left_set_point_2mm_s * 2e-3, ceiling_Nm);
    world.servo_wheel(robot_, Wheel::right, command.right_set_point_2mm_s * 2e-3, ceiling_Nm);
  }

  void sense(const World& world) override {
    measured_ = {world.rim_speed_m_s(robot_, Wheel::left), world.rim_speed_m_s(robot_, Wheel::right)};
  }

  [[nodiscard]] RimSpeeds measured() const override { return measured_; }

 private:
  std::size_t robot_;
  RimSpeeds measured_;
};

class DrivePlant final : public Plant {
 public:
  explicit DrivePlant(std::size_t robot) : robot_(robot) {}

  [[nodiscard]] std::uint32_t ticks_per_step() const override { return 1; }
  void reset() override { channels_ = {}; }

  void actuate(World& world, const can::WheelCommand& command, bool cut) override {
    const std::array torques_mNm = {command.left_torque_mNm, command.right_torque_mNm};
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const double wanted_Nm =
          cut ? 0.0 : std::clamp(torques_mNm[i] * 1e-3, -torque_ceiling_Nm, torque_ceiling_Nm);
      channels_[i].torque_Nm += current_loop_gain * (wanted_Nm - channels_[i].torque_Nm);
      world.torque_wheel(robot_, wheels[i], channels_[i].torque_Nm);
    }
  }

  void sense(const World& world) override {
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      Channel& channel = channels_[i];
      channel.travel_m += world.rim_speed_m_s(robot_, wheels[i]) * step_s;
      const double counts = std::floor(channel.travel_m / count_m);
      channel.speed_m_s = (counts - channel.counts) * count_m / step_s;
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

  static constexpr double step_s = 0.001;
  static constexpr double count_m = 2.0 * std::numbers::pi * wheel_radius_m / 16384.0;
  static constexpr double current_loop_gain = 0.6321205588285577;  // 1 - exp(-1 ms / 1 ms)

  std::size_t robot_;
  std::array<Channel, 2> channels_;
};

}  // namespace

std::string name_of(PlantKind kind) {
  return kind == PlantKind::servo ? "servo" : "drive";
}

std::unique_ptr<Plant> make_plant(PlantKind kind, std::size_t robot) {
  if (kind == PlantKind::servo) {
    return std::make_unique<ServoPlant>(robot);
  }
  return std::make_unique<DrivePlant>(robot);
}

}  // namespace striker::sil
