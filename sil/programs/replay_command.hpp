// SPDX-License-Identifier: Apache-2.0
// `striker-sil replay`: a recorded run in lockstep, given to a controller on any bus again.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace striker::sil {

// Of a replay that came out different.
inline constexpr int exit_differs = 1;

struct ReplayOptions {
  std::string log;
  std::string interface;
  std::string robot;
  std::string bus = "inproc";
  unsigned answer_timeout_ms = 1000;
  unsigned start_timeout_ms = 10000;
};

void define(CLI::App& replay, ReplayOptions& options);

// The exit status: 0 the same answers, 1 others, 130 interrupted.
int play_replay(const ReplayOptions& options);

}  // namespace striker::sil
