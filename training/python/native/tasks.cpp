// SPDX-License-Identifier: Apache-2.0
#include "training/python/native/tasks.hpp"

#include "sil/robot/description/robot_file.hpp"
#include "training/run/config.hpp"

namespace striker::training {

Tasks tasks_of(const std::optional<std::filesystem::path>& config, const std::string& text,
               const std::optional<std::filesystem::path>& robot, const std::vector<std::string>& changes) {
  std::vector<std::string> all = robot ? robot_changes(sil::read_robot(*robot)) : std::vector<std::string>();
  all.insert(all.end(), changes.begin(), changes.end());
  const Config read = config ? load_config(*config, all) : parse_config(text, "the environment", all);
  return {.environments = read.environments, .text = read.text};
}

}  // namespace striker::training
