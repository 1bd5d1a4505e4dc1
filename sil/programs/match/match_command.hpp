// SPDX-License-Identifier: Apache-2.0
// `striker-sil match`: one match of two teams.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "sil/match/play/match_setting.hpp"
#include "sil/programs/view/view_options.hpp"

namespace striker::sil {

struct MatchOptions {
  MatchSetting setting;
  std::string bus = "inproc";
  unsigned answer_timeout_ms = 1000;  // of a controller on a bus, and of a player program
  unsigned start_timeout_ms = 10000;
  double first_s = 0.0;  // play no more than so much simulated time; 0: the whole match
  std::string faults;    // a plan's file
  std::filesystem::path out;
  ViewOptions view;
};

void define(CLI::App& match, MatchOptions& options);

// The exit status: 0 played to its end, 130 interrupted.
int play_match(const MatchOptions& options);

}  // namespace striker::sil
