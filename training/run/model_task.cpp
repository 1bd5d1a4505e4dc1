// SPDX-License-Identifier: Apache-2.0
#include "training/run/model_task.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "training/run/config.hpp"

namespace striker::training {

TaskConfig task_of(const Model& model, const std::filesystem::path& config_file) {
  const auto noted = model.metadata.find("configuration");
  const bool has_note = noted != model.metadata.end();
  const Config config = !config_file.empty() ? load_config(config_file)
                        : has_note           ? parse_config(noted->second, "the model's configuration")
                                             : parse_config("", "the default configuration");
  TaskConfig task = config.environments.front();
  const Shape& shape = model.parameters.shape();
  if (shape.inputs != static_cast<int>(task.inputs.size()) ||
      shape.actions != static_cast<int>(task.actions.size())) {
    throw std::runtime_error(fmt::format(
        "the network has {} inputs and {} actions, but its task {} and {}; give the configuration whose "
        "task.inputs and task.actions it was trained with as --config",
        shape.inputs, shape.actions, task.inputs.size(), task.actions.size()));
  }
  return task;
}

}  // namespace striker::training
