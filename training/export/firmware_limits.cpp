// SPDX-License-Identifier: Apache-2.0
#include "training/export/firmware_limits.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/policy/policy.hpp"

namespace striker::training {

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
  if (const std::string why = unreachable_action(task); !why.empty()) {
    throw std::runtime_error(why);
  }
}

void require_header_compiles(const Shape& shape) {
  const std::vector<int> widths = shape.widths();
  std::size_t weights = 0;
  for (std::size_t layer = 1; layer < widths.size(); ++layer) {
    weights += static_cast<std::size_t>(widths[layer - 1]) * static_cast<std::size_t>(widths[layer]);
  }
  if (weights > most_weights) {
    throw std::runtime_error(fmt::format(
        "the network {} has {} weights, and the firmware's compilers take {} at most; train with a "
        "smaller network.hidden",
        fmt::join(widths, "-"), weights, most_weights));
  }
}

}  // namespace striker::training
