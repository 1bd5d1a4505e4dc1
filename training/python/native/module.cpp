// SPDX-License-Identifier: Apache-2.0
#include "training/python/native/module.hpp"

#include "training/task/episode_numbers.hpp"

PYBIND11_MODULE(_native, module) {
  using namespace striker::training;
  module.attr("FIRST_TRAINING_EPISODE") = first_training_episode;
  module.attr("FIRST_VALIDATION_EPISODE") = first_validation_episode;
  add_network(module);
  add_kick(module);
  add_match(module);
}
