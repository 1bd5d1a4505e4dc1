// SPDX-License-Identifier: Apache-2.0
// What a plan's faults do to the kick task: a row a case, over its episodes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sil/scenario/fault_run.hpp"

namespace striker::sil {

// Over a case's episodes: how the worst of them went.
struct FaultRow {
  std::string name;
  std::string faults;                           // in words
  std::string detected_by;                      // "nothing needed" if nobody had to
  std::optional<std::uint32_t> detected_ms;     // the longest
  std::optional<std::uint32_t> zero_torque_ms;  // the longest; nothing where it was driven on
  std::string outcome;
  std::optional<double> reward_kept_percent;  // nothing if the undisturbed reward is not above 0
  std::uint64_t violations = 0;
};

[[nodiscard]] FaultRow row_of(const FaultCase& faults, const std::vector<FaultResult>& results);

[[nodiscard]] std::string fault_table(const std::vector<FaultRow>& rows);

struct FaultReport {
  std::string plan;   // a file, or "built-in"
  std::string plant;  // as on the command line
  std::string pose;
  std::string bus;
  std::uint64_t seed = 0;
  std::uint64_t first_episode = 0;
  std::vector<FaultRow> rows;
  std::vector<std::vector<FaultResult>> results;  // of each row, an episode each
};

// JSON, stamped. Throws std::runtime_error that names the file and the way out.
void write_json(const FaultReport& report, const std::filesystem::path& file);

}  // namespace striker::sil
