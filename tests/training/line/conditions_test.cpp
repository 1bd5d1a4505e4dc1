// SPDX-License-Identifier: Apache-2.0
// Robots and cameras that are not the nominal ones, against the fast world and against what is seen of the nominal ones.
#include "training/line/conditions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sil/world/planar_world.hpp"
#include "training/line/line_episode.hpp"

namespace striker::training {
namespace {

constexpr std::uint64_t seed = 11;

// One episode in a robot's fast world, whose servos can be given any torque and told any time.
double world_reward(const core::RobotDescription& robot, std::uint64_t number, double torque_Nm,
                    int delay_steps, const std::vector<int>& actions) {
  const LineKick kick({.robot = robot});
  sil::PlanarWorld world(sil::kick_world(physics_step_s, {.robot = sil::spec_of(robot)}));
  sil::KickEpisode episode;
  episode.begin(world, sil::draw_kick(seed, number, sil::PoseMode::origin));
  double old_m_s = 0.0;
  for (const int action : actions) {
    for (int i = 0; i < steps_per_decision; ++i) {
      const double set_point_m_s = i < delay_steps ? old_m_s : kick.set_point_m_s(action);
      world.servo_wheel(0, sil::Wheel::left, set_point_m_s, torque_Nm);
      world.servo_wheel(0, sil::Wheel::right, set_point_m_s, torque_Nm);
      episode.step(world);
    }
    old_m_s = kick.set_point_m_s(action);
    (void)episode.end_decision();
  }
  return episode.outcome().reward;
}

double line_reward(const core::RobotDescription& robot, std::uint64_t number, const Conditions& conditions,
                   const std::vector<int>& actions) {
  const LineKick kick({.robot = robot});
  const LineEpisode episode = kick.draw(seed, number, conditions);
  LineRobot at;
  for (std::size_t i = 0; !at.over; ++i) {
    kick.step(episode, at, actions[i]);
  }
  return at.reward;
}

class RobotsConditions : public testing::TestWithParam<core::RobotDescription> {};
INSTANTIATE_TEST_SUITE_P(Conditions, RobotsConditions, testing::Values(core::forward, core::goalkeeper));

// A heavier robot is one with less torque; one that slips is one whose torque ends at the grip.
TEST_P(RobotsConditions, AreTheWorldsWithOtherServos) {
  const core::RobotDescription robot = GetParam();
  const sil::RobotSpec spec = sil::spec_of(robot);
  const double nominal_Nm = spec.max_wheel_torque_Nm;
  std::mt19937 random(2);
  int contacts = 0;
  for (std::uint64_t number = 0; number < 400; ++number) {
    std::vector<int> actions;
    actions.reserve(sil::kick_decisions);
    for (int i = 0; i < sil::kick_decisions; ++i) {
      actions.push_back(i == 0 || random() % 3 == 0 ? static_cast<int>(random() % 3) : actions.back());
    }
    const auto delay = static_cast<int>(number % 6);
    const Conditions weak{.mass_scale = 1.25, .torque_scale = 0.8, .command_delay_steps = delay};
    const double weak_reward = line_reward(robot, number, weak, actions);
    ASSERT_NEAR(weak_reward, world_reward(robot, number, 0.64 * nominal_Nm, delay, actions), 1e-9) << number;
    const double grip_Nm = 0.1 * sil::planar_model(spec).grip_N * spec.wheel_radius_m;
    ASSERT_LT(grip_Nm, nominal_Nm);
    ASSERT_NEAR(line_reward(robot, number, {.friction_scale = 0.1}, actions),
                world_reward(robot, number, grip_Nm, 0, actions), 1e-9);
    contacts += weak_reward > no_contact_reward ? 1 : 0;
  }
  EXPECT_GT(contacts, 30);
}

// The scales are factors of the robot's own numbers: it is another description's nominal robot then.
TEST_P(RobotsConditions, ScaleTheRobotsOwnNumbers) {
  core::RobotDescription other = GetParam();
  other.body_mass_g = other.body_mass_g * 3 / 2;
  other.wheel_mass_g = other.wheel_mass_g * 3 / 2;
  other.torque_limit_mNm /= 2;
  EXPECT_NEAR(gain_limit_m_s(GetParam(), {.mass_scale = 1.5, .torque_scale = 0.5}), gain_limit_m_s(other, {}),
              1e-12);
  other.tyre_friction_percent = 3;
  EXPECT_NEAR(gain_limit_m_s(GetParam(), {.friction_scale = 0.01}), gain_limit_m_s(other, {}), 1e-12);
  EXPECT_LT(gain_limit_m_s(other, {}), 0.1 * gain_limit_m_s(GetParam(), {}));
}

// A ball that is damped at rate k goes v (1 - exp(-k t)) / k; the world's steps of 10 ms go 0.1 % further.
TEST(Conditions, TheBallSlowsDownAtItsRate) {
  const LineKick kick{TaskConfig{}};
  for (const double scale : {0.0, 0.5, 1.0, 1.5}) {
    const LineEpisode episode = kick.draw(seed, 1, {.ball_damping_scale = scale});
    const sil::BallState start = sil::draw_kick(seed, 1, sil::PoseMode::origin).ball;
    const double time_s = 150 * physics_step_s;
    const double rate_per_s = scale * sil::damping_per_s;
    const double way_s = rate_per_s > 0.0 ? (1.0 - std::exp(-rate_per_s * time_s)) / rate_per_s : time_s;
    EXPECT_NEAR(episode.track.x_m[150], start.position_m.x + start.velocity_m_s.x * way_s, 0.006);
  }
}

TaskConfig seen_task() {
  return {.velocities = Velocities::estimated,
          .inputs = {{.element = Element::ball_x},
                     {.element = Element::ball_y},
                     {.element = Element::ball_vx},
                     {.element = Element::robot_speed},
                     {.element = Element::ball_x, .decisions_ago = greatest_look_back}}};
}

// A late picture is the one of a decision ago, of the ball and of the robot; the wheels are not late.
TEST(Conditions, ALatePictureIsTheLastOne) {
  const LineKick kick(seen_task());
  std::mt19937 random(2);
  int compared = 0;
  for (std::uint64_t number = 0; number < 50; ++number) {
    const LineEpisode nominal = kick.draw(seed, number);
    const LineEpisode late = kick.draw(seed, number, {.vision_late_frames = 1});
    LineRobot robot;
    Features now(5), last(5), seen(5);
    for (kick.look(nominal, robot, last); !robot.over; last = now) {
      kick.step(nominal, robot, static_cast<int>(random() % 3));
      if (!robot.over) {
        kick.look(nominal, robot, now);
        kick.look(late, robot, seen);
        EXPECT_NEAR(seen[0], last[0], 1e-6F);
        EXPECT_EQ(seen[1], last[1]);
        EXPECT_EQ(seen[2], last[2]);
        EXPECT_EQ(seen[3], now[3]);
        EXPECT_TRUE(robot.decision <= greatest_look_back || std::abs(seen[4] - last[4]) < 1e-6F);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 500);
}

// Ball and robot err by the same, each for itself; the next picture errs anew.
TEST(Conditions, TheNoiseIsAsStated) {
  const LineKick kick(seen_task());
  constexpr double noise_m = 0.005;
  double sum = 0.0;
  double squares = 0.0;
  double lagged = 0.0;
  int count = 0;
  for (std::uint64_t number = 0; number < 300; ++number) {
    const Eigen::MatrixXf nominal = kick.draw(seed, number).features;
    const Eigen::MatrixXf noisy = kick.draw(seed, number, {.vision_noise_m = noise_m}).features;
    const Eigen::VectorXd errors_m = (noisy - nominal).row(1).cast<double>().transpose() * position_unit_m;
    sum += errors_m.sum();
    squares += errors_m.squaredNorm();
    lagged += errors_m.head(errors_m.size() - 1).dot(errors_m.tail(errors_m.size() - 1));
    count += static_cast<int>(errors_m.size());
  }
  EXPECT_NEAR(sum / count, 0.0, 0.0003);
  EXPECT_NEAR(std::sqrt(squares / count), std::sqrt(2.0) * noise_m, 0.0002);
  EXPECT_NEAR(lagged / squares, 0.0, 0.03);
}

TEST(Conditions, AreDrawnWithinTheirRanges) {
  const RandomiseConfig ranges{.mass = {-0.3, 0.3},
                               .torque = {-0.2, 0.0},
                               .friction = {-0.8, -0.5},
                               .ball_damping = {-0.5, 0.5},
                               .command_delay_ms = {0.0, 50.0},
                               .vision_noise_mm = {0.0, 5.0},
                               .vision_late_ms = {0.0, 50.0}};
  sil::Random random(1, 1, 1);
  std::array<int, 6> delays{};
  std::array<int, 2> late{};
  for (int i = 0; i < 6000; ++i) {
    const Conditions drawn = draw_conditions(ranges, 1.0, random);
    EXPECT_NEAR(drawn.mass_scale, 1.0, 0.3);
    EXPECT_NEAR(drawn.torque_scale, 0.9, 0.1);
    EXPECT_NEAR(drawn.friction_scale, 0.35, 0.15);
    EXPECT_NEAR(drawn.ball_damping_scale, 1.0, 0.5);
    EXPECT_NEAR(drawn.vision_noise_m, 0.0025, 0.0025);
    ++delays.at(static_cast<std::size_t>(drawn.command_delay_steps));
    ++late.at(static_cast<std::size_t>(drawn.vision_late_frames));
  }
  for (const int count : delays) {
    EXPECT_NEAR(count, 1000, 150);
  }
  EXPECT_NEAR(late[0], 3000, 250);
  const Conditions nominal = draw_conditions(ranges, 0.0, random);
  EXPECT_EQ(gain_limit_m_s(core::forward, nominal), gain_limit_m_s(core::forward, {}));
  EXPECT_EQ(ball_kept(nominal), sil::kept_in_10_ms);
  EXPECT_EQ(nominal.command_delay_steps + nominal.vision_late_frames, 0);
  EXPECT_EQ(nominal.vision_noise_m, 0.0);
}

}  // namespace
}  // namespace striker::training
