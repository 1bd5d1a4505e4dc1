// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/match/league_command.hpp"

#include <fmt/format.h>

#include <set>
#include <string>

#include "firmware/host/command_line.hpp"
#include "firmware/host/stop_signal.hpp"
#include "sil/match/league/league_report.hpp"
#include "sil/programs/match/match_options.hpp"

namespace striker::sil {

void define(CLI::App& league, LeaguePlan& plan) {
  league.footer(
      "Matches that are in DIR already are kept: the same command goes on where it was interrupted. Under mpirun the "
      "processes share the matches. Exit status: 0 all were played; 2 wrong use, or a match or file that fails; 130 "
      "interrupted: the table is of those that were played.");
  league.add_option("--teams", plan.teams, "two or more, as A,B,C")
      ->delimiter(',')
      ->check(strategy_problem)
      ->capture_default_str();
  league
      .add_option("--pairs", plan.pairs,
                  "seeds for each two teams; each is played twice, with colours swapped")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100'000}))
      ->capture_default_str();
  league.add_flag("--mirrors", plan.mirrors, "each team against itself too, once a seed: a control");
  define_play(league, plan.match);
  league.add_option("--jobs", plan.jobs, "processes; the results are the same")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  league.add_option("-o,--out", plan.directory, "directory of the matches and the table")->required();
  league.final_callback([&plan] {
    if (plan.teams.size() < 2 || std::set(plan.teams.begin(), plan.teams.end()).size() != plan.teams.size()) {
      throw CLI::ValidationError("--teams", "give at least two, each once");
    }
  });
}

int play_league(const LeaguePlan& plan) {
  const PlayedLeague league = play_league(plan, host::stop_requested);
  if (!league.reports) {
    return 0;
  }
  fmt::print("{}", league_markdown(league.table));
  if (host::stop_requested()) {
    fmt::print(stderr,
               "striker-sil: stopped after {} of {} matches; the same command goes on with the rest\n",
               league.played, league.matches);
    return host::exit_interrupted;
  }
  return 0;
}

}  // namespace striker::sil
