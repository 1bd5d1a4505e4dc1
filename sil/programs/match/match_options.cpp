// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/match/match_options.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "sil/match/team/strategies.hpp"
#include "sil/match/team/tcp/tcp_strategy.hpp"

namespace striker::sil {

std::string strategy_problem(const std::string& name) {
  std::string known;
  for (const StrategyName& strategy : strategy_names()) {
    if (strategy.name == name) {
      return {};
    }
    known += fmt::format("{}{}", known.empty() ? "" : ", ", strategy.name);
  }
  return fmt::format("'{}' is no team: {}", name, known);
}

std::string team_problem(const std::string& name) {
  try {
    return tcp_port_of(name) ? std::string() : strategy_problem(name);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

void define_play(CLI::App& command, MatchSetting& setting) {
  command.add_option("--seed", setting.seed, "of formations, slip and strategies that draw")
      ->capture_default_str();
  command.add_option("--half-s", setting.half_s, "how long a half is, in s")
      ->check(CLI::Range(1, 3600))
      ->capture_default_str();
  command
      .add_option("--plant", setting.plant, "servo: AI Soccer's motors, 10 ms; drive: torque drives, 1 ms")
      ->check(CLI::IsMember({"servo", "drive"}))
      ->capture_default_str();
  command
      .add_option("--rules", setting.rules,
                  "published: as AI Soccer's referee of 2019; official: with its slips mended")
      ->check(CLI::IsMember({"official", "published"}))
      ->capture_default_str();
  command
      .add_option("--slip", setting.slip,
                  "each wheel's speed is up to this share more or less, drawn every physics step")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      .add_option("--jitter", setting.jitter_mm,
                  "formations are up to so many mm, and tenths of a degree, beside their spots")
      ->check(CLI::Range(0.0, 50.0))
      ->capture_default_str();
}

}  // namespace striker::sil
