// SPDX-License-Identifier: Apache-2.0
// The paper's experiment: variants of one training, each over several seeds.
//
// A run is one variant with one seed. Its three files are written when it is complete, its figures last, so
// that what is there can be kept when the experiment is interrupted:
//   DIR/runs/VARIANT/seed-N.csv           the learning curve: episode, reward, moving average of 250
//   DIR/runs/VARIANT/seed-N.safetensors   the network
//   DIR/runs/VARIANT/seed-N.json          its figures, and the identity of its configuration
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "training/run/config.hpp"

namespace striker::training {

struct Variant {
  std::string name;  // also its directory's
  std::string says;  // in words, for tables
  Config config;
};

// RCS, RCS with 1, 2, 4 (the ACS's size) and 8 dummies, the true ACS at the origin and anywhere, RCS with the
// printed equations; all others as in `base`.
[[nodiscard]] std::vector<Variant> paper_variants(const std::string& base_text, const std::string& base_name);

// What the paper leaves open, each reading alone and some together, with the RCS state.
[[nodiscard]] std::vector<Variant> paper_readings(const std::string& base_text, const std::string& base_name);

// Networks from half to three times the width of `base`'s default, 64: the paper does not give its own.
[[nodiscard]] std::vector<Variant> network_widths(const std::string& base_text, const std::string& base_name);

// Other people's: one variant a file, named as the file is without its extension; `changes` go for all. Throws
// std::runtime_error, naming the file, if a name stands twice or two files are the same training.
[[nodiscard]] std::vector<Variant> compared_variants(const std::vector<std::filesystem::path>& files,
                                                     const std::vector<std::string>& changes);

struct SeedRun {
  const Variant* variant = nullptr;
  std::uint64_t seed = 0;
};

[[nodiscard]] std::string name_of(const SeedRun& run);  // "rcs+1, seed 3"

// Evaluated greedily on the same held-out episodes, at the origin and anywhere.
inline constexpr int evaluation_episodes = 2000;
inline constexpr std::uint64_t evaluation_seed = 1000;

struct RunFigures {
  std::vector<double> rewards;  // an episode each
  double origin_mean = 0.0;
  double anywhere_mean = 0.0;
};

// Trains and evaluates, and writes the run's files.
void carry_out(const SeedRun& run, const std::filesystem::path& directory);

// The files of a run: .csv, .safetensors, .json.
[[nodiscard]] std::array<std::filesystem::path, 3> files_of(const SeedRun& run,
                                                            const std::filesystem::path& directory);

// Nothing if it is not there. Throws std::runtime_error, naming the file and the way out, if it is damaged or
// was made with another configuration.
[[nodiscard]] std::optional<RunFigures> load_run(const SeedRun& run, const std::filesystem::path& directory);

}  // namespace striker::training
