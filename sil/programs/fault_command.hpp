// SPDX-License-Identifier: Apache-2.0
// `striker-sil faults`: each fault of a plan against the kick task.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace striker::sil {

struct FaultOptions {
  std::string plan;  // empty: the built-in one
  bool all = false;
  std::string plant = "drive";
  std::string pose = "origin";
  std::string bus = "inproc";
  std::uint64_t episodes = 3;
  std::uint64_t first = 0;
  std::uint64_t seed = 1;
  int jobs = 1;
  std::string json;
};

void define(CLI::App& faults, FaultOptions& options);

inline constexpr int exit_violated = 1;  // an invariant did not hold

// The exit status.
[[nodiscard]] int play_faults(const FaultOptions& options);

}  // namespace striker::sil
