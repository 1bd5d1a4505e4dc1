// SPDX-License-Identifier: Apache-2.0
#include "training/task/task_config.hpp"

#include <algorithm>

namespace striker::training {

std::vector<SetPoint> kick_actions() {
  constexpr double steady_m_s = forward_spec.max_rim_speed_m_s;
  return {{steady_m_s, steady_m_s}, {0.0, 0.0}, {-steady_m_s, -steady_m_s}};
}

int mirrored_action(const std::vector<SetPoint>& actions, int action) {
  const auto image =
      std::find(actions.begin(), actions.end(), mirrored(actions[static_cast<std::size_t>(action)]));
  return image == actions.end() ? -1 : static_cast<int>(image - actions.begin());
}

}  // namespace striker::training
