// SPDX-License-Identifier: Apache-2.0
// Kicks with drives of one kind, for the Python tests: prints every episode's reward, a line each; writes the bus as a
// candump log if a file is named. Usage: drive_kicks striker|odrive|cia402 EPISODES [LOG]
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

#include "sil/record/candump_log.hpp"
#include "tests/drives/drive_rig.hpp"

int main(int argc, char** argv) {
  using namespace striker;
  const auto& names = can::drive_kind_names;
  const std::string name = argc > 2 ? argv[1] : "";
  const auto* const found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    fmt::print(stderr, "usage: drive_kicks striker|odrive|cia402 EPISODES [LOG]\n");
    return 2;
  }
  std::optional<sil::CandumpLog> log;
  std::vector<sil::Observer*> observers;
  if (argc > 3) {
    observers.push_back(&log.emplace(argv[3]));
  }
  sil::DriveRig rig(static_cast<can::DriveKind>(found - names.begin()));
  const auto outcomes = rig.play({.episodes = std::strtoull(argv[2], nullptr, 10)}, observers);
  for (const sil::KickOutcome& outcome : outcomes) {
    fmt::print("{}\n", outcome.reward);
  }
  fmt::print(stderr, "{} episodes were not driven all along\n", rig.undriven.size());
  return rig.undriven.empty() ? 0 : 1;
}
