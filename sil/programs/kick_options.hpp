// SPDX-License-Identifier: Apache-2.0
// The command line of `striker-sil kick`.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "sil/programs/view/view_options.hpp"

namespace striker::sil {

// For --bus: what is wrong with it, and the way out; and the interface of can:IFACE.
[[nodiscard]] std::string bus_problem(const std::string& bus);
[[nodiscard]] inline std::string interface_of(const std::string& bus) {
  return bus == "inproc" ? std::string() : bus.substr(4);
}

struct KickOptions {
  std::string bus = "inproc";
  std::string plant = "drive";
  std::string task = "kick";
  std::string pose = "origin";
  std::string robot;
  std::string policy;  // empty: the built-in one
  std::string vary;
  std::uint64_t episodes = 20;
  std::uint64_t first = 0;
  std::uint64_t seed = 1;
  bool real_time = false;
  std::int64_t bitrate = 0;  // 0: the bus takes no time
  double step_us = 50.0;
  double vision_phase_us = 0.0;
  unsigned answer_timeout_ms = 1000;
  unsigned start_timeout_ms = 10000;
  std::string json;
  std::string log;
  std::string decisions;
  ViewOptions view;

  [[nodiscard]] bool in_process() const { return bus == "inproc"; }
};

// Options that mean nothing with the others are refused. `options` outlives the parsing.
void define(CLI::App& kick, KickOptions& options);

}  // namespace striker::sil
