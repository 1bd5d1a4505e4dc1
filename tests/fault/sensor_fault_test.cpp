// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "sil/fault/link/recode.hpp"
#include "sil/fault/sensor/camera_faults.hpp"
#include "sil/fault/sensor/drive_faults.hpp"
#include "sil/fault/sensor/plant_faults.hpp"
#include "sil/robot/striker_drives.hpp"
#include "tests/fault/fault_rig.hpp"

namespace striker::sil {
namespace {

constexpr std::uint32_t from = 100;
constexpr std::uint32_t until = 400;

// Sees something else in every picture, without a world.
class CountingCamera final : public Camera {
 public:
  [[nodiscard]] Picture look(const World&) override {
    ++pictures_;
    const double x = 0.1 * pictures_;
    return {.robot = {.x_m = x, .y_m = 0.2, .heading_rad = 0.3}, .ball_m = {1.0 + x, 0.5}};
  }

 private:
  int pictures_ = 0;
};

// Pictures at ticks 0, 50, ... 450 through one fault; number 2 is the first faulty one, number 8 the first after.
std::vector<Picture> pictures(FaultKind kind, double value = 0.0, std::uint32_t count = 1) {
  World world{WorldConfig{}};
  CountingCamera camera;
  TimedFault fault = fault_of(kind, from, until);
  fault.fault.value = value;
  fault.fault.count = count;
  std::uint32_t now = 0;
  CameraFault faulty(camera, fault, any_random(), now);
  std::vector<Picture> seen;
  for (; now < 500; now += 50) {
    seen.push_back(faulty.look(world));
  }
  return seen;
}

TEST(CameraFault, EachShowsWhatItSaysInItsWindowOnly) {
  const auto honest = pictures(FaultKind::camera_bias, 0.0);
  EXPECT_DOUBLE_EQ(pictures(FaultKind::camera_frozen)[5].robot.x_m, honest[2].robot.x_m);
  EXPECT_DOUBLE_EQ(pictures(FaultKind::camera_late, 0.0, 3)[5].ball_m.x, honest[2].ball_m.x);
  const auto jump = pictures(FaultKind::camera_jump, 2.0);
  EXPECT_DOUBLE_EQ(jump[2].robot.x_m, honest[2].robot.x_m + 2.0);
  EXPECT_DOUBLE_EQ(jump[3].robot.x_m, honest[3].robot.x_m);
  EXPECT_DOUBLE_EQ(pictures(FaultKind::camera_turn)[4].robot.heading_rad, 0.3 + std::numbers::pi);
  EXPECT_DOUBLE_EQ(pictures(FaultKind::camera_bias, 0.5)[4].ball_m.y, 1.0);
  EXPECT_DOUBLE_EQ(pictures(FaultKind::camera_mirrored)[4].robot.y_m, -0.2);
  EXPECT_DOUBLE_EQ(pictures(FaultKind::camera_mirrored)[4].ball_m.y, -0.5);
  const auto ball = pictures(FaultKind::ball_jumps, 1.0);
  EXPECT_DOUBLE_EQ(ball[2].ball_m.x - honest[2].ball_m.x, 1.0);
  EXPECT_DOUBLE_EQ(ball[3].ball_m.x - honest[3].ball_m.x, -1.0);
  for (const FaultKindInfo& info : fault_kinds()) {
    if (info.place == FaultPlace::camera) {
      const auto seen = pictures(info.kind, 0.5);
      for (const std::size_t number : {0U, 1U, 8U, 9U}) {
        EXPECT_DOUBLE_EQ(seen[number].robot.x_m, honest[number].robot.x_m) << info.name;
        EXPECT_DOUBLE_EQ(seen[number].ball_m.x, honest[number].ball_m.x) << info.name;
      }
    }
  }
}

TEST(CameraFault, NoiseStaysWithinItsRange) {
  const auto honest = pictures(FaultKind::camera_bias, 0.0);
  const auto noisy = pictures(FaultKind::camera_noise, 0.05);
  bool differs = false;
  for (std::size_t i = 2; i < 8; ++i) {
    EXPECT_LE(std::abs(noisy[i].robot.x_m - honest[i].robot.x_m), 0.05);
    differs = differs || noisy[i].robot.x_m != honest[i].robot.x_m;
  }
  EXPECT_TRUE(differs);
}

can::WheelState told(FaultKind kind, double value, FaultyWheel wheel, std::uint32_t tick) {
  TimedFault fault = fault_of(kind, from, until);
  fault.fault.value = value;
  fault.fault.wheel = wheel;
  StrikerDrives drives;
  DriveFault faulty(drives, fault);
  std::vector<can::Frame> frames;
  faulty.report({.left_m_s = 1.0, .right_m_s = 2.5}, tick, frames);
  EXPECT_EQ(frames.size(), 1U);
  return read<can::WheelState>(frames.front()).value();
}

TEST(DriveFault, EachTellsWhatItSaysWithTheProtectionRight) {
  const auto both = FaultyWheel::both;
  EXPECT_EQ(told(FaultKind::wheels_frozen, 700.0, FaultyWheel::left, from).left_mm_s, 700);
  EXPECT_EQ(told(FaultKind::wheels_frozen, 700.0, FaultyWheel::left, from).right_mm_s, 2500);
  EXPECT_EQ(told(FaultKind::wheels_reversed, 0.0, both, from).right_mm_s, -2500);
  EXPECT_EQ(told(FaultKind::wheels_swapped, 0.0, both, from).left_mm_s, 2500);
  EXPECT_EQ(told(FaultKind::wheels_scaled, 0.5, FaultyWheel::right, from).right_mm_s, 1250);
  EXPECT_EQ(told(FaultKind::wheels_wrapped, 2048.0, both, from).right_mm_s, 2500 - 4096);
  EXPECT_EQ(told(FaultKind::wheels_wrapped, 2048.0, both, from).left_mm_s, 1000);
  EXPECT_EQ(told(FaultKind::wheels_jump, 2900.0, both, from).left_mm_s, 2900);
  EXPECT_EQ(told(FaultKind::wheels_jump, 2900.0, both, from + 1).left_mm_s, -2900);
  EXPECT_EQ(told(FaultKind::torque_cut_told, 0.0, both, from).torque_cut, 1);
  EXPECT_EQ(told(FaultKind::wheels_reversed, 0.0, both, until).right_mm_s, 2500);
}

// Full torque forward on both wheels for a time; the rims' true speeds and what is measured.
struct Drive {
  RimSpeeds truly;
  RimSpeeds measured;
};

Drive drive(FaultKind kind, double value, FaultyWheel wheel) {
  TimedFault fault = fault_of(kind, 0, 1000);
  fault.fault.value = value;
  fault.fault.wheel = wheel;
  const auto plant = make_plant(PlantKind::drive, 0, robot_spec(Role::forward));
  std::uint32_t now = 0;
  PlantFault faulty(*plant, 0, fault, now);
  World world({.walls = false, .step_s = 0.001});
  world.place_robot(0, {});
  for (; now < 100; ++now) {
    faulty.actuate(world, {WheelOrder{0.3, 1.0}, WheelOrder{0.3, 1.0}}, false);
    world.step();
    faulty.sense(world);
  }
  return {.truly = plant->measured(), .measured = faulty.measured()};
}

TEST(PlantFault, AStuckWheelStandsAndTheOtherTurns) {
  const Drive stuck = drive(FaultKind::wheel_stuck, 0.0, FaultyWheel::left);
  EXPECT_NEAR(stuck.truly.left_m_s, 0.0, 0.05);
  EXPECT_GT(stuck.truly.right_m_s, 0.2);
}

TEST(PlantFault, ASlippingWheelIsMeasuredFasterThanItRolls) {
  const Drive slips = drive(FaultKind::wheel_slips, 0.2, FaultyWheel::right);
  EXPECT_GT(slips.measured.right_m_s, slips.truly.right_m_s + 0.5);
  EXPECT_DOUBLE_EQ(slips.measured.left_m_s, slips.truly.left_m_s);
}

TEST(PlantFault, WeakMotorsAreSlower) {
  const Drive weak = drive(FaultKind::torque_saturated, 0.3, FaultyWheel::both);
  const Drive strong = drive(FaultKind::torque_saturated, 1.0, FaultyWheel::both);
  EXPECT_NEAR(weak.truly.left_m_s / strong.truly.left_m_s, 0.3, 0.1);
}

}  // namespace
}  // namespace striker::sil
