// SPDX-License-Identifier: Apache-2.0
// A real robot is never the described one. What the controller makes of others, in the full world over its bus.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "sil/bus/in_process_link.hpp"
#include "tests/scenario/kick_rig.hpp"

namespace striker::sil {
namespace {

struct Play {
  double mean_reward = 0.0;
  std::size_t undriven = 0;
};

Play play(const std::string& variation, const core::RobotDescription& told = core::forward,
          std::uint64_t episodes = 60) {
  InProcessLink link(core::profile_of(told));
  KickRig rig(link, PlantKind::drive, variation_of(variation));
  Play result;
  for (const KickOutcome& outcome : rig.play({.seed = 9,
                                    .episodes = episodes,
                                    .pictures_a_motion = core::pictures_a_motion(core::profile_of(told))})) {
    result.mean_reward += outcome.reward / static_cast<double>(episodes);
  }
  result.undriven = rig.undriven.size();
  return result;
}

TEST(VariedRobot, OneThatIsLighterOrStrongerKicksAsWell) {
  const double described = play("").mean_reward;
  for (const std::string variation : {"mass=0.9", "mass=0.7", "torque=1.1", "torque=1.3"}) {
    const Play seen = play(variation);
    EXPECT_GT(seen.mean_reward, described - 0.5) << variation;
    EXPECT_EQ(seen.undriven, 0U) << variation << ": a fault where nothing is wrong";
  }
}

// How well they kick is the policy's affair.
TEST(VariedRobot, NoHonestOneIsAFault) {
  for (const std::string variation : {"mass=1.3", "torque=0.7", "friction=0.6", "ball_damping=0.5",
                                      "ball_damping=1.5", "vision_noise_mm=2"}) {
    EXPECT_EQ(play(variation).undriven, 0U) << variation;
  }
}

TEST(VariedRobot, AsDescribedIsTheOfficialRobotToTheByte) {
  const auto bus_of = [](const std::string& variation) {
    InProcessLink link;
    BusRecord bus;
    KickRig(link, PlantKind::drive, variation_of(variation)).play({.seed = 9, .episodes = 2}, {&bus});
    return bus.frames;
  };
  ASSERT_NO_FATAL_FAILURE(expect_same(bus_of(""), bus_of("mass=1.0,vision_latency_ms=0,friction=1")));
}

// How far outside AI Soccer's field the robot's centre comes that is as described. It may start anywhere in it, and face
// outwards.
double way_outside_m(const core::RobotDescription& told, std::uint32_t delay_ms = 0) {
  InProcessLink link(core::profile_of(told));
  double farthest_m = -10.0;
  AtEndOfTick watch([&](const Snapshot& snapshot) {
    const Pose& pose = snapshot.robots.front().pose;
    farthest_m = std::max({farthest_m, std::abs(pose.x_m) - 3.9, std::abs(pose.y_m) - 2.325});
  });
  Variation late;
  late.command_delay_ms = delay_ms;
  KickRig rig(link, PlantKind::drive, late);
  rig.play({.pose = PoseMode::anywhere, .seed = 12, .episodes = 60, .place = {.robot = spec_of(told)}},
           {&watch});
  EXPECT_TRUE(rig.undriven.empty());
  return farthest_m;
}

TEST(VariedRobot, NoKickLeavesTheFieldOfTheDescription) {
  EXPECT_GT(way_outside_m(core::forward), 1.0);
  core::RobotDescription told = core::forward;
  told.field_half_length_mm = 3'900;
  told.field_half_width_mm = 2'325;
  EXPECT_LT(way_outside_m(told), 0.0);
  core::RobotDescription strong = told;
  strong.torque_limit_mNm = 800;
  EXPECT_LT(way_outside_m(strong), 0.0);
  core::RobotDescription light = told;
  light.body_mass_g = 1'200;
  EXPECT_LT(way_outside_m(light), 0.0);
  for (const std::int32_t friction_percent : {30, 60, 100}) {
    core::RobotDescription slippery = told;
    slippery.tyre_friction_percent = friction_percent;
    EXPECT_LT(way_outside_m(slippery), 0.0) << friction_percent;
  }
  core::RobotDescription late = told;
  late.command_delay_ms = 50;
  EXPECT_LT(way_outside_m(late, 50), 0.0);
}

// The same robot with a late camera: the controller that was told leads its pictures on, one that was not kicks worse
// but takes nothing for a fault.
TEST(VariedRobot, ALateCameraCostsLittleWhereItIsDescribed) {
  const double described = play("").mean_reward;
  core::RobotDescription late = core::forward;
  late.camera_latency_ms = 50;
  const Play told = play("vision_latency_ms=50", late);
  EXPECT_GT(told.mean_reward, described - 0.5);
  EXPECT_EQ(told.undriven, 0U);
  const Play untold = play("vision_latency_ms=50");
  EXPECT_LT(untold.mean_reward, told.mean_reward);
  EXPECT_EQ(untold.undriven, 0U);
}

core::RobotDescription forward_with_camera(std::int32_t rate_Hz, std::int32_t latency_ms) {
  core::RobotDescription robot = core::forward;
  robot.camera_rate_Hz = rate_Hz;
  robot.camera_latency_ms = latency_ms;
  return robot;
}

TEST(VariedRobot, ACameraOfAnotherRateCostsLittleWhereItIsDescribed) {
  const double described = play("").mean_reward;
  const Play told = play("camera_rate_Hz=60,vision_latency_ms=35", forward_with_camera(60, 35));
  EXPECT_GT(told.mean_reward, described - 0.5);
  EXPECT_EQ(told.undriven, 0U);
}

// Forty decisions, from the first picture of the episode on.
TEST(VariedRobot, NoCamerasRateLeavesAnEpisodeUndriven) {
  for (std::int32_t rate_Hz = 10; rate_Hz <= 100; ++rate_Hz) {
    const std::string variation = "camera_rate_Hz=" + std::to_string(rate_Hz);
    EXPECT_EQ(play(variation, forward_with_camera(rate_Hz, 0), 3).undriven, 0U) << variation;
  }
}

TEST(VariedRobot, ACameraOfAnotherRateThanDescribedIsNotBelieved) {
  EXPECT_EQ(play("camera_rate_Hz=60").undriven, 60U);
  EXPECT_EQ(play("camera_rate_Hz=10").undriven, 60U);
  EXPECT_EQ(play("camera_rate_Hz=20", forward_with_camera(60, 0)).undriven, 60U);
  EXPECT_EQ(play("camera_rate_Hz=25").undriven, 60U);
}

TEST(VariedRobot, LateCommandsCostLittleWhereTheyAreDescribed) {
  const double described = play("").mean_reward;
  core::RobotDescription late = core::forward;
  late.command_delay_ms = 20;
  // It is never known to the millisecond.
  for (const std::string variation : {"command_delay_ms=17", "command_delay_ms=20", "command_delay_ms=23"}) {
    const Play told = play(variation, late);
    EXPECT_GT(told.mean_reward, described - 0.5) << variation;
    EXPECT_EQ(told.undriven, 0U) << variation;
  }
}

TEST(Variation, IsReadOrRefusedByName) {
  const Variation read = variation_of("mass=0.9,vision_latency_ms=35,vision_noise_mm=2.5");
  EXPECT_EQ(read, (Variation{.mass = 0.9, .vision_noise_mm = 2.5, .vision_latency_ms = 35}));
  EXPECT_EQ(variation_of(""), Variation{});
  for (const std::string wrong : {"mass", "mass=", "mass=nan", "mass=0", "mas=1", "vision_latency_ms=1.5",
                                  "vision_latency_ms=51", "camera_rate_Hz=9", "camera_rate_Hz=20.5", "=1",
                                  "mass=0.9,", ",mass=0.9", "mass=0.9,,torque=1", ",", "mass=0.9,mass=0.9"}) {
    EXPECT_THROW((void)variation_of(wrong), std::runtime_error) << wrong;
  }
}

}  // namespace
}  // namespace striker::sil
