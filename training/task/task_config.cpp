// SPDX-License-Identifier: Apache-2.0
#include "training/task/task_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sil/world/robot_specs.hpp"

namespace striker::training {

std::vector<SetPoint> kick_actions(const core::RobotDescription& robot) {
  const double steady_m_s = sil::spec_of(robot).max_rim_speed_m_s;
  return {{steady_m_s, steady_m_s}, {0.0, 0.0}, {-steady_m_s, -steady_m_s}};
}

int mirrored_action(const std::vector<SetPoint>& actions, int action) {
  const auto image =
      std::find(actions.begin(), actions.end(), mirrored(actions[static_cast<std::size_t>(action)]));
  return image == actions.end() ? -1 : static_cast<int>(image - actions.begin());
}

std::string unreachable_action(const TaskConfig& task) {
  const double top_m_s = sil::spec_of(task.robot).max_rim_speed_m_s;
  for (std::size_t action = 0; action < task.actions.size(); ++action) {
    const auto& [left_m_s, right_m_s] = task.actions[action];
    // Written so that NaN is none that it reaches, too.
    if (!(std::abs(left_m_s) <= top_m_s && std::abs(right_m_s) <= top_m_s)) {
      return fmt::format(
          "task.actions[{}] = [{}, {}]: a wheel of the robot reaches {} m/s; train with set-points from -{} to {}",
          action, left_m_s, right_m_s, top_m_s, top_m_s, top_m_s);
    }
  }
  return "";
}

}  // namespace striker::training
