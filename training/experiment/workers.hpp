// SPDX-License-Identifier: Apache-2.0
// Independent pieces of work, each in a process of its own: one that dies takes nothing else with it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace striker::training {

struct WorkerFailure {
  std::size_t task = 0;
  std::string why;  // "killed by signal 9 (Killed)", or what the work's exception said
};

// Carries out `work(task)` for every task, at most `jobs` at a time, in order. `finished` is called in this
// process after each one that succeeded; `stop` is asked between them: true starts no more (and the
// terminal's Ctrl-C has ended those that run). Returns the tasks that failed.
std::vector<WorkerFailure> run_workers(const std::vector<std::size_t>& tasks, int jobs,
                                       const std::function<void(std::size_t)>& work,
                                       const std::function<void(std::size_t)>& finished,
                                       const std::function<bool()>& stop);

}  // namespace striker::training
