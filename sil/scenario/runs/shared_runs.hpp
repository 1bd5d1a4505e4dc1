// SPDX-License-Identifier: Apache-2.0
// Many runs, each a pure function of its number, each a line of a results file (run_file.hpp): shared among processes
// of this machine and of one `mpirun` (Open MPI's, or any that sets OMPI_COMM_WORLD_RANK and _SIZE), interrupted and
// gone on with at any time, and the same file in the end. The processes of an mpirun need one file system; no MPI
// library is needed. The first of them waits for the others and sorts the file.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "sil/scenario/runs/run_file.hpp"

namespace striker::sil {

struct SharedRuns {
  std::uint64_t runs = 0;    // numbers 0 to runs - 1
  int jobs = 1;              // processes of this machine
  std::string unit = "run";  // for the progress
  std::chrono::seconds longest_run{120};
  std::function<std::string(std::uint64_t)> carry_out;  // in a worker: the run's line
  std::function<std::string(std::uint64_t, const std::string& why)>
      failed;  // the line of one whose process died
};

// Returns false in all but the first process of an mpirun: those have nothing to report. `stop` is asked all the time.
[[nodiscard]] bool carry_out(const SharedRuns& shared, RunFile& file, const std::function<bool()>& stop);

}  // namespace striker::sil
