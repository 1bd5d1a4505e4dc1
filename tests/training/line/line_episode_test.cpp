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
                                         aimed(every_input(Velocities::estimated, core::goalkeeper))));

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
