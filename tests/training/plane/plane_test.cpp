// SPDX-License-Identifier: Apache-2.0
// A plane's cells are what an episode shows and pays.
#include "training/plane/plane.hpp"

#include "tests/training/fixtures.hpp"
#include "training/ceiling/rivals.hpp"
#include "training/export/export.hpp"
#include "training/task/kick_environment.hpp"

namespace striker::training {
namespace {

constexpr std::uint64_t seed = 41;

// Reads what was one and two decisions ago, too.
TaskConfig far_sighted_task() {
  TaskConfig task{.physics = Physics::planar};
  for (const int ago : {1, 2}) {
    task.inputs.push_back({.element = Element::ball_x, .decisions_ago = ago});
    task.inputs.push_back({.element = Element::ball_vy, .decisions_ago = ago});
  }
  task.inputs.push_back({.element = Element::decisions_left});
  task.one_sided = true;
  return task;
}

Model model_for(const TaskConfig& task) {
  return {.parameters = some_parameters(1, {.inputs = static_cast<int>(task.inputs.size())}), .metadata = {}};
}

// Whose first cell is the situation that the episode has come to.
Plane plane_through(const KickEnvironment& env) {
  const RcsState& seen = env.state();
  return {.x = {.number = PlaneNumber::ball_x_m, .from = seen.ball_x_m, .to = seen.ball_x_m + 1.0},
          .y = {.number = PlaneNumber::ball_y_m, .from = seen.ball_y_m, .to = seen.ball_y_m + 1.0},
          .held = {0.0, 0.0, seen.robot_speed_m_s, seen.ball_vx_m_s, seen.ball_vy_m_s,
                   static_cast<double>(env.decisions_left())},
          .cells = 2};
}

TEST(Plane, ACellIsWhatAnEpisodeShowsOfIt) {
  const TaskConfig task = far_sighted_task();
  const Model model = model_for(task);
  const IntegerNetwork integers = integers_of(model, task);
  Actor actor(model.parameters.shape());
  KickEnvironment env(task);
  int compared = 0;
  for (std::uint64_t episode = 0; episode < 20; ++episode) {
    env.reset(seed, episode);
    for (int waited = 0; waited < 4; ++waited) {
      env.step(1);
    }
    const PlaneCell cell = fill(plane_through(env), model.parameters, integers, task).front();
    if (env.success() || cell.touches) {
      continue;
    }
    ++compared;
    const auto q = actor.values(model.parameters, env.features());
    for (std::size_t action = 0; action < plane_actions; ++action) {
      EXPECT_NEAR(cell.float_q[action], q[static_cast<Eigen::Index>(action)], 1e-3) << episode;
      EXPECT_NEAR(cell.integer_q[action], cell.float_q[action], 0.05) << episode;
    }
    EXPECT_EQ(cell.float_action, greedy_action(q)) << episode;
    EXPECT_EQ(cell.planner_action, plan_ahead(env)) << episode;
  }
  EXPECT_GT(compared, 15);
}

// Planning anew on the way can only find something better, and hardly ever does.
TEST(Plane, APlannedRewardIsWhatTheWorldPays) {
  const TaskConfig task{.physics = Physics::planar};
  const Model model = model_for(task);
  const IntegerNetwork integers = integers_of(model, task);
  KickEnvironment env(task);
  double paid_in_all = 0.0;
  double planned_in_all = 0.0;
  for (std::uint64_t episode = 0; episode < 60; ++episode) {
    env.reset(seed, episode);
    const PlaneCell cell = fill(plane_through(env), model.parameters, integers, task).front();
    for (std::size_t action = 0; action < plane_actions; ++action) {
      env.reset(seed, episode);
      StepResult step = env.step(static_cast<int>(action));
      double paid = step.reward;
      while (!step.end) {
        step = env.step(plan_ahead(env));
        paid += step.reward;
      }
      EXPECT_GE(paid, cell.planned[action] - 1e-6) << episode << ", action " << action;
      paid_in_all += paid;
      planned_in_all += cell.planned[action];
    }
  }
  EXPECT_NEAR(paid_in_all / 180, planned_in_all / 180, 0.1);
  EXPECT_GT(planned_in_all / 180, 5.0);
}

TEST(Plane, EndsAfterARowAndKnowsWhatTouches) {
  const TaskConfig task{.physics = Physics::planar};
  const Model model = model_for(task);
  const Plane plane = {.x = {.number = PlaneNumber::ball_x_m, .from = 0.0, .to = 1.0},
                       .y = {.number = PlaneNumber::ball_y_m, .from = 0.0, .to = 1.0},
                       .held = {0.0, 0.0, 0.0, 0.0, 0.0, 30.0},
                       .cells = 3};
  const auto cells = fill(plane, model.parameters, integers_of(model, task), task, [] { return false; });
  ASSERT_EQ(cells.size(), 3U);
  EXPECT_TRUE(cells[0].touches);
  EXPECT_FALSE(cells[1].touches);
  EXPECT_TRUE(cells[1].contact) << "a ball at rest 0.5 m ahead";
  EXPECT_EQ(cells[1].planner_action, 0);
}

TEST(Plane, OnlyTasksWithThePlannersActionsHaveOne) {
  TaskConfig task{.physics = Physics::planar};
  EXPECT_EQ(unfit_for_plane(task), "");
  task.robot.command_delay_ms = 20;
  EXPECT_NE(unfit_for_plane(task).find("command_delay_ms"), std::string::npos);
  task = {.physics = Physics::planar};
  task.actions.push_back({.left_m_s = 1.0, .right_m_s = 1.0});
  EXPECT_NE(unfit_for_plane(task).find("task.actions"), std::string::npos);
  task = {.physics = Physics::planar};
  task.inputs = acs_inputs();
  EXPECT_NE(unfit_for_plane(task).find("task.inputs"), std::string::npos);
}

}  // namespace
}  // namespace striker::training
