// SPDX-License-Identifier: Apache-2.0
// The fast world beside the full wheel bodies: on 1,000 random action sequences, in turns, at other steps.
#include "sil/world/planar_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

constexpr double pi = std::numbers::pi;

// Every other sequence holds each action for up to 12 decisions: those reach full speed.
Actions sequence(std::uint64_t episode) {
  if (episode % 2 == 1) {
    return random_actions(episode);
  }
  constexpr std::uint64_t stream = 98;
  Random random(7, episode, stream);
  Actions actions;
  while (actions.size() < kick_decisions) {
    const auto held = 1 + random.below(12);
    actions.insert(actions.end(), held, static_cast<int>(random.below(3)) - 1);
  }
  actions.resize(kick_decisions);
  return actions;
}

struct Spread {
  std::vector<double> values;

  [[nodiscard]] double at(double share) {
    std::sort(values.begin(), values.end());
    return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
  }
  void expect_below(const char* name, double median, double most_of_99, double max) {
    std::printf("%-34s median %.1e  99 %% %.1e  max %.1e  (%zu)\n", name, at(0.5), at(0.99), at(1.0),
                values.size());
    EXPECT_LT(at(0.5), median) << name;
    EXPECT_LT(at(0.99), most_of_99) << name;
    EXPECT_LT(at(1.0), max) << name;
  }
};

struct Differences {
  Spread position_m;  // the largest of an episode, until the contact
  Spread speed_m_s;
  Spread reward;
  Spread ball_speed_m_s;
  Spread ball_angle_rad;
  int one_contact_only = 0;
  int other_step = 0;
  int other_face = 0;
  int other_kick = 0;
};

void compare(World& full, PlanarWorld& fast, std::uint64_t number, Differences& differences) {
  const KickStart start = draw_kick(3, number, PoseMode::anywhere);
  const Actions actions = sequence(number);
  const auto steps = std::lround(decision_period_s / full.step_s());
  std::array<KickEpisode, 2> episodes;
  episodes[0].begin(full, start);
  episodes[1].begin(fast, start);
  std::array<long, 2> contact_step{};
  double apart_m = 0.0;
  double faster_m_s = 0.0;
  for (int decision = 0; decision < kick_decisions + 2; ++decision) {
    const int action = decision < kick_decisions ? actions.at(static_cast<std::size_t>(decision)) : 0;
    drive_straight(full, action * 2.55);
    drive_straight(fast, action * 2.55);
    for (long i = 0; i < steps; ++i) {
      episodes[0].step(full);
      episodes[1].step(fast);
      bool contact = false;
      for (std::size_t k = 0; k < 2; ++k) {
        contact_step.at(k) += episodes.at(k).outcome().contact ? 0 : 1;
        contact = contact || episodes.at(k).outcome().contact;
      }
      if (!contact) {
        const Pose a = full.robot_pose(0);
        const Pose b = fast.robot_pose(0);
        const Vec2 u = full.robot_velocity_m_s(0);
        const Vec2 v = fast.robot_velocity_m_s(0);
        apart_m = std::max(apart_m, std::hypot(a.x_m - b.x_m, a.y_m - b.y_m));
        faster_m_s = std::max(faster_m_s, std::hypot(u.x - v.x, u.y - v.y));
      }
    }
    episodes[0].end_decision();
    episodes[1].end_decision();
  }
  differences.position_m.values.push_back(apart_m);
  differences.speed_m_s.values.push_back(faster_m_s);
  const KickOutcome& a = episodes[0].outcome();
  const KickOutcome& b = episodes[1].outcome();
  differences.one_contact_only += a.contact != b.contact ? 1 : 0;
  if (!a.contact || !b.contact) {
    return;
  }
  differences.other_step += contact_step[0] != contact_step[1] ? 1 : 0;
  differences.other_face += a.front_face != b.front_face ? 1 : 0;
  differences.other_kick += a.kicked != b.kicked ? 1 : 0;
  differences.reward.values.push_back(std::abs(a.reward - b.reward));
  differences.ball_speed_m_s.values.push_back(std::abs(a.ball_speed_m_s - b.ball_speed_m_s));
  differences.ball_angle_rad.values.push_back(
      std::abs(std::remainder(a.ball_angle_rad - b.ball_angle_rad, 2.0 * pi)));
}

// Measured: the robot 15 um apart in the middle, 162 um at most; every contact in the same step; the reward
// 0.00008 apart in the middle, 0.0012 at most. What remains is the tyres' softness and the body's pitch.
TEST(PlanarWorld, OneThousandRandomSequencesAreThoseOfTheFullWorld) {
  World full(kick_world(0.010));
  PlanarWorld fast(0.010);
  Differences differences;
  for (std::uint64_t i = 0; i < 1'000; ++i) {
    compare(full, fast, i, differences);
  }
  EXPECT_GT(differences.reward.values.size(), 150U);
  differences.position_m.expect_below("robot's position until contact, m", 3e-5, 2e-4, 3e-4);
  differences.speed_m_s.expect_below("robot's speed until contact, m/s", 2e-4, 4e-4, 1e-3);
  differences.reward.expect_below("reward", 2e-4, 2e-3, 3e-3);
  differences.ball_speed_m_s.expect_below("ball's speed 100 ms later, m/s", 2e-3, 0.1, 0.2);
  differences.ball_angle_rad.expect_below("ball's direction then, rad", 1e-3, 0.05, 0.1);
  EXPECT_EQ(differences.one_contact_only, 0);
  EXPECT_EQ(differences.other_step, 0);
  EXPECT_EQ(differences.other_face, 0);
  EXPECT_EQ(differences.other_kick, 0);
}

TEST(PlanarWorld, FollowsTheFullWorldAtOtherSteps) {
  World full(kick_world(0.001));
  PlanarWorld fast(0.001);
  Differences differences;
  for (std::uint64_t i = 0; i < 40; ++i) {
    compare(full, fast, i, differences);
  }
  EXPECT_GT(differences.reward.values.size(), 5U);
  differences.position_m.expect_below("robot's position, 1 ms steps, m", 3e-5, 1e-4, 2e-4);
  differences.reward.expect_below("reward, 1 ms steps", 5e-4, 2e-3, 2e-3);
  EXPECT_EQ(differences.one_contact_only, 0);
}

// A second of driving along an arc, from rest.
TEST(PlanarWorld, GentleTurnsAreThoseOfTheFullWorld) {
  struct Rims {
    double left_m_s;
    double right_m_s;
  };
  for (const Rims& rims : {Rims{0.25, -0.25}, Rims{1.0, 0.5}, Rims{2.3, 2.55}, Rims{-1.0, -1.4}}) {
    World full(kick_world(0.010));
    PlanarWorld fast(0.010);
    const auto turned = [&rims](auto& world) {
      world.place_robot(0, {});
      world.place_ball({.position_m = {50.0, 0.0}, .velocity_m_s = {}});
      drive(world, 0, rims.left_m_s, rims.right_m_s, 0.4);
      run(world, 1.0);
      return world.robot_pose(0);
    };
    const Pose a = turned(full);
    const Pose b = turned(fast);
    EXPECT_GT(std::abs(a.heading_rad), 1.0);
    EXPECT_NEAR(a.heading_rad, b.heading_rad, 0.05 * std::abs(a.heading_rad));
    EXPECT_LT(std::hypot(a.x_m - b.x_m, a.y_m - b.y_m), 0.03);
  }
}

TEST(PlanarWorld, RunsTheSameAfterAnythingElse) {
  PlanarWorld busy(0.010);
  for (std::uint64_t i = 0; i < 100; ++i) {
    play(busy, draw_kick(3, i, PoseMode::anywhere), sequence(i));
  }
  int contacts = 0;
  for (std::uint64_t i = 100; i < 150; ++i) {
    PlanarWorld fresh(0.010);
    const KickStart start = draw_kick(3, i, PoseMode::anywhere);
    const KickOutcome late = play(busy, start, sequence(i));
    const KickOutcome alone = play(fresh, start, sequence(i));
    EXPECT_EQ(late.reward, alone.reward);
    EXPECT_EQ(late.ball_speed_m_s, alone.ball_speed_m_s);
    EXPECT_EQ(late.ball_angle_rad, alone.ball_angle_rad);
    contacts += late.contact ? 1 : 0;
  }
  EXPECT_GT(contacts, 0);
}

template <typename AnyWorld>
double sum_of_rewards(AnyWorld world) {
  double sum = 0.0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    sum += play(world, draw_kick(3, i, PoseMode::anywhere), sequence(i)).reward;
  }
  return sum;
}

TEST(Worlds, RunInSeveralThreadsAtOnce) {
  const double fast = sum_of_rewards(PlanarWorld(0.010));
  const double full = sum_of_rewards(World(kick_world(0.010)));
  std::array<double, 4> sums{};
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      threads.emplace_back([&sums, i] {
        sums.at(i) =
            i % 2 == 0 ? sum_of_rewards(PlanarWorld(0.010)) : sum_of_rewards(World(kick_world(0.010)));
      });
    }
  }
  EXPECT_EQ(sums[0], fast);
  EXPECT_EQ(sums[1], full);
  EXPECT_EQ(sums[2], fast);
  EXPECT_EQ(sums[3], full);
}

TEST(PlanarWorld, RefusesWhatItDoesNotHold) {
  EXPECT_THROW(PlanarWorld(0.0), std::invalid_argument);
  PlanarWorld world;
  EXPECT_THROW(world.place_robot(1, {}), std::out_of_range);
  EXPECT_THROW(world.servo_wheel(1, Wheel::left, 0.0, 0.0), std::out_of_range);
  EXPECT_THROW((void)world.robot_pose(1), std::out_of_range);
}

}  // namespace
}  // namespace striker::sil
