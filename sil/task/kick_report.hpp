// SPDX-License-Identifier: Apache-2.0
// What a run over many kick episodes says: the same figures and the same JSON from every program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sil/task/kick_task.hpp"

namespace striker::sil {

struct KickRun {
  std::uint64_t seed = 0;
  std::uint64_t first_episode = 0;  // the number of the first row
  std::string plant;                // "servo" or "drive"
  std::string pose;                 // "origin" or "anywhere"
  std::string robot = {};           // the file of its description; empty: the built-in one
  std::string variation = {};       // of the robot from its description, as on the command line; empty: none
  std::string policy_name = {};     // where it is known what its header calls it
  std::string policy;               // the identity of the policy or model, 8 hexadecimal digits
  double simulated_s = 0.0;
  double wall_s = 0.0;
  std::vector<KickOutcome> episodes;
  std::vector<std::uint64_t> undriven = {};  // numbers of those that no controller drove all along
};

struct KickSummary {
  double mean_reward = 0.0;
  double reward_ci95 = 0.0;  // half-width, normal approximation: 1.96 s / sqrt(n)
  double contact_rate = 0.0;
  double kick_rate = 0.0;
};

[[nodiscard]] KickSummary kick_summary(const std::vector<KickOutcome>& episodes);

// The JSON summary with the per-episode rows. Written to a temporary file, then renamed. Throws
// std::runtime_error that names the file and the way out.
void write_json(const KickRun& run, const std::filesystem::path& file);

// A row of it: a line of JSON, for a journal of a run that may end at any moment.
[[nodiscard]] std::string row_line(std::uint64_t episode, const KickOutcome& outcome, bool driven);

// The table for a terminal: a row an episode, then the means, the policy if it has a name, and
// what is no result of it.
[[nodiscard]] std::string format_table(const KickRun& run, bool rows);

}  // namespace striker::sil
