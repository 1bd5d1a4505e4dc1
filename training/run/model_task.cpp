// SPDX-License-Identifier: Apache-2.0
#include "training/run/model_task.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace striker::training {

TaskConfig task_of(const Model& model, const std::filesystem::path& file,
                   const std::filesystem::path& config_file) {
  const auto noted = model.metadata.find("configuration");
  const bool has_note = noted != model.metadata.end();
  const Config config = !config_file.empty() ? load_config(config_file)
                        : has_note ? parse_config(noted->second, file.string() + ", the configuration in it")
                                   : parse_config("", "the default configuration");
  TaskConfig task = config.environments.front();
  const Shape& shape = model.parameters.shape();
  if (shape.inputs != static_cast<int>(task.inputs.size()) ||
      shape.actions != static_cast<int>(task.actions.size())) {
    throw std::runtime_error(fmt::format(
        "{}: the network has {} inputs and {} actions, but its task {} and {}; give the configuration whose "
        "task.inputs and task.actions it was trained with as --config",
        file.string(), shape.inputs, shape.actions, task.inputs.size(), task.actions.size()));
  }
  return task;
}

TaskConfig with_robot(TaskConfig task, const core::RobotDescription& robot) {
  task.robot = robot;
  if (const std::string why = unreachable_action(task); !why.empty()) {
    throw std::runtime_error("the robot is too slow for the model: " + why);
  }
  return task;
}

void require_fits(const Model& model, const Config& config, const std::string& file) {
  const auto refuse = [&file](const std::string& why) {
    throw std::runtime_error(fmt::format("{}: a training cannot begin from it: {}", file, why));
  };
  const auto widths = model.parameters.shape().widths();
  if (config.shape.dueling) {
    refuse("network.dueling = true, but a model holds plain Q values; set network.dueling = false");
  }
  if (config.shape.widths() != widths) {
    refuse(
        fmt::format("its network is {}, the configuration's {}; change network.hidden, task.inputs or "
                    "task.actions",
                    fmt::join(widths, "-"), fmt::join(config.shape.widths(), "-")));
  }
  const TaskConfig& task = config.environments.front();
  const auto noted = model.metadata.find("configuration");
  if (noted == model.metadata.end()) {
    return;
  }
  const TaskConfig own = parse_config(noted->second, file + ", the configuration in it").environments.front();
  for (const auto& [key, equal] : {std::pair("task.inputs", own.inputs == task.inputs),
                                   std::pair("task.actions", own.actions == task.actions),
                                   std::pair("task.mirrored", own.one_sided == task.one_sided)}) {
    if (!equal) {
      refuse(fmt::format("its {} is another; set it as in the model's configuration", key));
    }
  }
}

}  // namespace striker::training
