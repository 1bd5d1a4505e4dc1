// SPDX-License-Identifier: Apache-2.0
// Many independent runs, each a line of text, in a few processes: one that crashes or hangs takes nothing with it
// but itself, and is told.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace striker::sil {

struct PoolResult {
  std::uint64_t task = 0;
  std::string line;  // what the work returned, without its end of line
  std::string
      failure;  // instead of it: "killed by signal 11 (Segmentation fault)", or what an exception said
};

struct PoolSize {
  int jobs = 1;
  std::chrono::seconds longest_run{120};  // a task that takes longer is lost
};

// Carries out `work` for every task, in `jobs` processes (forked from this one), each task once. `done` is called
// in this process as results come, in any order; `stop` is asked between them: true ends the rest.
void run_in_processes(std::span<const std::uint64_t> tasks, const PoolSize& size,
                      const std::function<std::string(std::uint64_t)>& work,
                      const std::function<void(const PoolResult&)>& done, const std::function<bool()>& stop);

}  // namespace striker::sil
