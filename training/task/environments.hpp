// SPDX-License-Identifier: Apache-2.0
// Every kind of environment: what `task.kind` chooses from. A new task adds its class here, its name in
// TaskKind (task_config.hpp) and in task_reader.cpp.
#pragma once

#include <variant>

#include "training/task/kick_environment.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

using AnyEnvironment = std::variant<KickEnvironment>;

// Code that plays it is given the class itself by std::visit, so that no decision goes through a table of
// functions.
[[nodiscard]] inline AnyEnvironment make_environment(const TaskConfig& task) {
  switch (task.kind) {
    case TaskKind::kick:
      break;
  }
  return KickEnvironment(task);
}

}  // namespace striker::training
