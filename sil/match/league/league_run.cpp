// SPDX-License-Identifier: Apache-2.0
#include "sil/match/league/league_run.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "firmware/host/files.hpp"
#include "firmware/host/version.hpp"
#include "sil/match/league/league_report.hpp"
#include "sil/match/play/match_links.hpp"
#include "sil/match/record/match_report.hpp"
#include "sil/match/team/strategies.hpp"
#include "sil/scenario/runs/shared_runs.hpp"

namespace striker::sil {

namespace {

class Figures final : public MatchObserver {
 public:
  void frame(const MatchFrame& frame) override { statistics_.add(frame); }
  [[nodiscard]] const MatchFigures& figures() const { return statistics_.figures(); }

 private:
  MatchStatistics statistics_;
};

MatchResult played(const MatchSetting& setting) {
  const MatchLinks links = links_in_process();
  std::array<std::unique_ptr<Strategy>, 2> strategies;
  Figures figures;
  std::array<MatchObserver*, 1> records = {&figures};
  MatchParts parts{.teams = {}, .links = {}, .records = records, .buses = {}};
  for (const Team team : teams) {
    auto& strategy = strategies[index_of(team)];
    strategy = make_strategy(setting.teams[index_of(team)], team_seed(setting, team));
    parts.teams[index_of(team)] = strategy.get();
  }
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    parts.links[robot] = links[robot].get();
  }
  const MatchPlan plan = plan_of(setting);
  MatchRun run(plan, parts);
  const MatchEnd end = run.run([] { return false; });
  return match_result(match_json(plan.header, figures.figures(), end), "this match");
}

std::string line_of(std::uint64_t number, const MatchResult& result) {
  nlohmann::ordered_json line = {{"run", number}};
  line.update(json_of(result));
  return line.dump();
}

void require_that_match(const std::filesystem::path& file, const MatchResult& result,
                        const MatchSetting& match, std::uint64_t number) {
  if (result.teams != match.teams || result.seed != match.seed || !result.complete) {
    throw std::runtime_error(fmt::format(
        "{}: run {} is not the match {} against {} of seed {}, played to its end: give another --out, or "
        "remove the line",
        file.string(), number, match.teams[0], match.teams[1], match.seed));
  }
}

// What the matches in a file are of; others than these are refused there.
std::string header_of(const LeaguePlan& plan) {
  const MatchSetting& match = plan.match;
  const nlohmann::ordered_json header = {
      {"league", plan.teams},         {"seed", match.seed},      {"half_s", match.half_s},
      {"rules", match.rules},         {"plant", match.plant},    {"slip", match.slip},
      {"jitter_mm", match.jitter_mm}, {"mirrors", plan.mirrors}, {"git_hash", host::git_hash()}};
  return header.dump();
}

}  // namespace

std::vector<MatchSetting> matches_of(const LeaguePlan& plan) {
  std::vector<MatchSetting> matches;
  for (std::uint64_t pair = 0; pair < plan.pairs; ++pair) {
    for (std::size_t i = 0; i < plan.teams.size(); ++i) {
      for (std::size_t j = plan.mirrors ? i : i + 1; j < plan.teams.size(); ++j) {
        MatchSetting match = plan.match;
        match.seed += pair;
        match.teams = {plan.teams[i], plan.teams[j]};
        matches.push_back(match);
        if (i != j) {
          match.teams = {plan.teams[j], plan.teams[i]};
          matches.push_back(match);
        }
      }
    }
  }
  return matches;
}

PlayedLeague play_league(const LeaguePlan& plan, const std::function<bool()>& stop) {
  const std::vector<MatchSetting> matches = matches_of(plan);
  host::require_writable(plan.directory);
  const std::filesystem::path matches_jsonl = plan.directory / "matches.jsonl";
  RunFile file(matches_jsonl, header_of(plan));
  const SharedRuns shared = {
      .runs = matches.size(),
      .jobs = plan.jobs,
      .unit = "match",
      .longest_run = std::chrono::hours(2),
      .carry_out = [&](std::uint64_t number) { return line_of(number, played(matches[number])); },
      .failed = [&](std::uint64_t number, const std::string& why) -> std::string {
        throw std::runtime_error(fmt::format("the match {} against {} of seed {}: {}",
                                             matches[number].teams[0], matches[number].teams[1],
                                             matches[number].seed, why));
      }};
  if (!carry_out(shared, file, stop)) {
    return {.table = {}, .reports = false};
  }
  std::vector<MatchResult> results;
  for (const auto& [number, line] : file.runs()) {
    if (number < matches.size()) {
      results.push_back(match_result(nlohmann::ordered_json::parse(line),
                                     fmt::format("{}: run {}", matches_jsonl.string(), number)));
      require_that_match(matches_jsonl, results.back(), matches[number], number);
    }
  }
  PlayedLeague league{.table = league_table(results), .played = results.size(), .matches = matches.size()};
  write_league(league.table, plan.directory);
  return league;
}

}  // namespace striker::sil
