// SPDX-License-Identifier: Apache-2.0
// A campaign: many random cases of faults, each in one episode. A run is a pure function of (seed, number), so that
// the results are the same with any number of processes, and after any number of interruptions.
//
// DIR/runs.jsonl holds a line a run, whole lines only: appended as runs end, sorted by number when all are there. Its
// first line says what they are runs of: seed, policy, protocol. DIR/violation-N.toml is the smallest plan that still
// breaks the invariant of run N: `striker-sil faults --plan`.
//
// Several processes of one `mpirun` share the runs (runs/shared_runs.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace striker::sil {

struct CampaignOptions {
  std::uint64_t runs = 1000;
  std::uint64_t seed = 1;
  int jobs = 1;
  std::filesystem::path directory;
};

struct CampaignSummary {
  std::uint64_t runs = 0;            // that are there
  std::uint64_t violations = 0;      // runs with one
  std::uint64_t detected = 0;        // runs in which the controller told a fault
  std::string first_violation = {};  // one line; empty if there is none
  bool reports = true;               // false in all but the first process of an mpirun
};

// Throws std::runtime_error with one line that names file, what is wrong, and the way out.
[[nodiscard]] CampaignSummary run_campaign(const CampaignOptions& options, const std::function<bool()>& stop);

}  // namespace striker::sil
