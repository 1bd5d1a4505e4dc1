// SPDX-License-Identifier: Apache-2.0
#include "training/export/firmware_limits.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "firmware/policy/policy.hpp"

namespace striker::training {

namespace {

void require_within_robot(const SetPoint& set_point, std::size_t action) {
  constexpr double top_m_s = forward_spec.max_rim_speed_m_s;
  // Written so that NaN is refused, too.
  const bool within = std::abs(set_point.left_m_s) <= top_m_s && std::abs(set_point.right_m_s) <= top_m_s;
  if (!within) {
    throw std::runtime_error(fmt::format(
        "task.actions[{}] = [{}, {}]: a wheel of the forward reaches {} m/s; train with set-points from "
        "-{} to {}",
        action, set_point.left_m_s, set_point.right_m_s, top_m_s, top_m_s, top_m_s));
  }
}

}  // namespace

void require_firmware_serves(const TaskConfig& task) {
  if (task.equations == Equations::printed) {
    throw std::runtime_error(
        "the model was trained with the paper's printed equations, which the firmware does "
        "not compute; train with equations = \"corrected\"");
  }
  for (const StateInput& input : task.inputs) {
    if (facts_of(input.element).raw_per_value == 0.0) {
      throw std::runtime_error(fmt::format(
          "the model reads {}, which the controller does not know; train with inputs = \"rcs\" or those that "
          "paper.toml says the controller has",
          facts_of(input.element).name));
    }
  }
  if (task.inputs.size() > policy::greatest_inputs) {
    throw std::runtime_error(fmt::format("the model reads {} inputs; the controller offers room for {}",
                                         task.inputs.size(), policy::greatest_inputs));
  }
  for (std::size_t action = 0; action < task.actions.size(); ++action) {
    require_within_robot(task.actions[action], action);
  }
}

}  // namespace striker::training
