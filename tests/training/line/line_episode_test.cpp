// SPDX-License-Identifier: Apache-2.0
// Plays on a line against the environment itself: the same inputs, the same end, the same reward.
#include "training/line/line_episode.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/training/fixtures.hpp"
#include "training/ceiling/rivals.hpp"
#include "training/line/planner.hpp"

namespace striker::training {
namespace {

TaskConfig every_input(Velocities velocities, const core::RobotDescription& robot = core::forward) {
  TaskConfig task{.robot = robot, .velocities = velocities, .one_sided = true};
  task.inputs.clear();
  for (int element = 0; element <= static_cast<int>(Element::decisions_left); ++element) {
    for (const int ago : {0, 1, greatest_look_back}) {
      task.inputs.push_back({.element = static_cast<Element>(element), .decisions_ago = ago});
    }
  }
  task.actions.push_back({.left_m_s = 1.3, .right_m_s = 1.3});
  return task;
}

TaskConfig with_other_rules(TaskConfig task) {
  task.rules = {.slowest_ball_m_s = 0.5,
                .fastest_ball_m_s = 4.0,
                .aim_radius_m = 0.1,
                .waiting_reward = -0.3,
                .angle_reward = 2.0,
                .speed_reward_s_m = 5.0,
                .signed_speed = false};
  return task;
}

TaskConfig aimed(TaskConfig task) {
  task.rules.reward = sil::KickReward::aimed;
  return task;
}

// 2.8 kg in all, on tyres that slip before its torque ends.
constexpr core::RobotDescription slippery = {.body_mass_g = 2500,
                                             .wheel_mass_g = 100,
                                             .wheel_radius_um = 50'000,
                                             .axle_length_um = 200'000,
                                             .torque_limit_mNm = 2000,
                                             .top_rim_speed_mm_s = 3000,
                                             .tyre_friction_percent = 60};

core::RobotDescription late(int command_delay_ms, int camera_latency_ms) {
  core::RobotDescription robot = core::forward;
  robot.command_delay_ms = command_delay_ms;
  robot.camera_latency_ms = camera_latency_ms;
  return robot;
}

class LineKicks : public testing::TestWithParam<TaskConfig> {};

// Random actions, held for a while.
TEST_P(LineKicks, AreTheEnvironments) {
  const LineKick kick(GetParam());
  KickEnvironment env(GetParam());
  Features features(GetParam().inputs.size());
  std::mt19937 random(3);
  int contacts = 0;
  for (std::uint64_t number = 0; number < 300; ++number) {
    const LineEpisode episode = kick.draw(5, number);
    env.reset(5, number);
    LineRobot robot;
    int action = 0;
    bool end = false;
    while (!end) {
      action = random() % 4 == 0 ? static_cast<int>(random() % 4) : action;
      if (!robot.over) {
        kick.look(episode, robot, features);
        ASSERT_LT((features - env.features()).cwiseAbs().maxCoeff(), 1e-6F) << number;
        kick.step(episode, robot, action);
      }
      end = env.step(action).end;
      ASSERT_TRUE(robot.over || !end) << number;
      ASSERT_EQ(robot.contact, env.success()) << number;
    }
    ASSERT_NEAR(robot.reward, env.outcome().reward, 1e-9) << number;
    contacts += robot.contact ? 1 : 0;
  }
  EXPECT_GT(contacts, 30);
}

INSTANTIATE_TEST_SUITE_P(Rollout, LineKicks,
                         testing::Values(every_input(Velocities::exact), every_input(Velocities::estimated),
                                         with_other_rules(every_input(Velocities::exact)),
                                         every_input(Velocities::exact, core::goalkeeper),
                                         with_other_rules(every_input(Velocities::estimated, core::defender)),
                                         every_input(Velocities::estimated, slippery),
                                         aimed(every_input(Velocities::exact)),
                                         aimed(every_input(Velocities::estimated, core::goalkeeper)),
                                         aimed(every_input(Velocities::exact, late(43, 35))),
                                         every_input(Velocities::exact, late(20, 0)),
                                         every_input(Velocities::estimated, late(43, 35)),
                                         every_input(Velocities::exact, late(50, 50))));

// What a late robot sees in a decision is where things are when that decision begins to act: until then all it does is
// ordered, and the ball rolls on.
TEST(LineKick, SeesWhereThingsAreWhenItsDecisionActs) {
  // With 50 ms a whole decision is the last one's.
  for (const int delay_ms : {0, 50}) {
    TaskConfig task{.robot = late(delay_ms, 50), .velocities = Velocities::exact};
    task.inputs = {{.element = Element::ball_x}, {.element = Element::robot_speed}};
    const LineKick kick(task);
    std::mt19937 random(6);
    int compared = 0;
    for (std::uint64_t number = 0; number < 100; ++number) {
      const LineEpisode episode = kick.draw(5, number);
      LineRobot robot;
      while (!robot.over) {
        Features seen(2);
        kick.look(episode, robot, seen);
        const int step = robot.decision * steps_per_decision + delay_ms / physics_step_ms;
        const LineState before = robot.now;
        kick.step(episode, robot, static_cast<int>(random() % 3));
        if (!robot.over) {
          const LineState& acts = delay_ms == 0 ? before : robot.now;
          const double ball_x_m = episode.track.x_m[static_cast<std::size_t>(step)] - acts.position_m;
          EXPECT_NEAR(seen[0] * position_unit_m, ball_x_m, 1e-3) << number;
          EXPECT_NEAR(seen[1] * speed_unit_m_s, acts.speed_m_s, 1e-6) << number;
          ++compared;
        }
      }
    }
    EXPECT_GT(compared, 1000) << delay_ms;
  }
}

// Commands that are a whole decision late make it the game of a robot that stands for a decision and then plays on: the same
// inputs a decision later, the count included, and the same reward.
TEST(LineKick, AWholeDecisionLateIsADecisionLater) {
  TaskConfig task{.velocities = Velocities::exact};
  task.inputs.clear();
  for (int element = 0; element <= static_cast<int>(Element::decisions_left); ++element) {
    task.inputs.push_back({.element = static_cast<Element>(element)});
  }
  const LineKick at_once(task);
  task.robot = late(50, 0);
  const LineKick late_one(task);
  std::mt19937 random(8);
  int contacts = 0;
  for (std::uint64_t number = 0; number < 300; ++number) {
    const LineEpisode episode = at_once.draw(5, number);
    const LineEpisode late_episode = late_one.draw(5, number);
    LineRobot robot;
    LineRobot late_robot;
    constexpr int stop = 1;
    at_once.step(episode, robot, stop);
    int action = 0;
    while (!robot.over) {
      Features seen(static_cast<Eigen::Index>(task.inputs.size()));
      Features late_seen(static_cast<Eigen::Index>(task.inputs.size()));
      at_once.look(episode, robot, seen);
      late_one.look(late_episode, late_robot, late_seen);
      ASSERT_LT((seen - late_seen).cwiseAbs().maxCoeff(), 1e-5F) << number << ' ' << robot.decision;
      action = random() % 4 == 0 ? static_cast<int>(random() % 3) : action;
      at_once.step(episode, robot, action);
      late_one.step(late_episode, late_robot, action);
    }
    while (!late_robot.over) {
      late_one.step(late_episode, late_robot, action);
    }
    EXPECT_NEAR(late_robot.reward, robot.reward, 1e-9) << number;
    contacts += robot.contact ? 1 : 0;
  }
  EXPECT_GT(contacts, 30);
}

// From the start of an episode the plans are those that the ceiling's planner knows.
TEST(Plans, AreWorthWhatTheCeilingsPlannerSays) {
  for (const auto& [robot, reward] :
       {std::pair(core::forward, sil::KickReward::contact),
        std::pair(core::goalkeeper, sil::KickReward::contact), std::pair(slippery, sil::KickReward::contact),
        std::pair(core::forward, sil::KickReward::aimed)}) {
    const LineKick kick({.robot = robot, .rules = {.reward = reward}});
    for (std::uint64_t number = 0; number < 200; ++number) {
      const LineEpisode episode = kick.draw(5, number);
      const PlanValue value = best_plan(line_drive(robot, reward), episode.track, {}, sil::kick_decisions);
      ASSERT_NEAR(plan_reward(kick, episode, {}), std::max(value.reward, no_contact_reward), 1e-9) << number;
    }
  }
}

TEST(LineKick, RefusesWhatIsNotOnALine) {
  EXPECT_EQ(LineKick::unfit({}), "");
  const auto refused = [](const char* key, const TaskConfig& task) {
    EXPECT_EQ(LineKick::unfit(task).find(key), 0U) << LineKick::unfit(task);
    EXPECT_THROW((void)LineKick(task), std::invalid_argument);
  };
  refused("task.world", {.physics = Physics::full});
  refused("task.pose", {.pose = sil::PoseMode::anywhere});
  refused("task.equations", {.equations = Equations::printed});
  refused("task.inputs", {.inputs = acs_inputs()});
  refused("task.actions", {.actions = {{1.0, 1.0}, {1.0, -1.0}}});
  refused("reward.contacts", {.rules = {.every_contact = true}});
  refused("reward.after_contact", {.goes_on = true});
}

}  // namespace
}  // namespace striker::training
