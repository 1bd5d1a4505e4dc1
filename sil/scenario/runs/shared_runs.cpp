// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/runs/shared_runs.hpp"

#include <thread>
#include <vector>

#include "firmware/host/progress.hpp"
#include "sil/scenario/runs/mpi_ranks.hpp"
#include "sil/scenario/runs/worker_pool.hpp"

namespace striker::sil {

namespace {

void carry_out_share(const SharedRuns& shared, const Ranks& ranks, RunFile& file,
                     const std::function<bool()>& stop) {
  std::vector<std::uint64_t> tasks;
  std::int64_t share = 0;
  for (std::uint64_t number = ranks.rank; number < shared.runs; number += ranks.size) {
    ++share;
    if (!file.runs().contains(number)) {
      tasks.push_back(number);
    }
  }
  const std::int64_t before = share - static_cast<std::int64_t>(tasks.size());
  std::int64_t done = before;
  host::ProgressLine progress(shared.unit, share, before);
  run_in_processes(
      tasks, {.jobs = shared.jobs, .longest_run = shared.longest_run}, shared.carry_out,
      [&](const PoolResult& result) {
        file.append(result.task,
                    result.failure.empty() ? result.line : shared.failed(result.task, result.failure));
        if (progress.due(++done)) {
          progress.show(done, "");
        }
      },
      stop);
  progress.finish();
}

bool complete(const RunFile& file, std::uint64_t runs) {
  for (std::uint64_t number = 0; number < runs; ++number) {
    if (!file.runs().contains(number)) {
      return false;
    }
  }
  return true;
}

void wait_for_others(std::uint64_t runs, RunFile& file, const std::function<bool()>& stop) {
  constexpr std::chrono::milliseconds pause{200};
  while (!complete(file, runs) && !stop()) {
    std::this_thread::sleep_for(pause);
    file.read_again();
  }
}

}  // namespace

bool carry_out(const SharedRuns& shared, RunFile& file, const std::function<bool()>& stop) {
  const Ranks ranks = ranks_of_mpirun();
  carry_out_share(shared, ranks, file, stop);
  if (ranks.rank > 0) {
    return false;
  }
  if (ranks.size > 1) {
    wait_for_others(shared.runs, file, stop);
  }
  if (ranks.size == 1 || complete(file, shared.runs)) {
    file.finish();
  }
  return true;
}

}  // namespace striker::sil
