// SPDX-License-Identifier: Apache-2.0
#include "sil/match/league/match_result.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>

#include "firmware/host/files.hpp"

namespace striker::sil {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 2> colours = {"red", "blue"};

template <class T>
T value_at(const Json& report, const std::string& pointer, std::string_view source) {
  const Json::json_pointer place(pointer);
  if (!report.contains(place)) {
    throw std::runtime_error(
        fmt::format("{}: {} is missing: a match.json of this version is needed", source, pointer));
  }
  try {
    return report.at(place).get<T>();
  } catch (const Json::exception&) {
    throw std::runtime_error(
        fmt::format("{}: {} is {}, which it cannot be: a match.json of this version is needed", source,
                    pointer, report.at(place).dump()));
  }
}

std::string pointer_to(std::size_t team, const LeagueColumn& column) {
  return fmt::format("/{}{}", colours[team], column.pointer);
}

}  // namespace

MatchResult match_result(const Json& report, std::string_view source) {
  MatchResult result;
  result.teams = value_at<std::array<std::string, 2>>(report, "/teams", source);
  result.seed = value_at<std::uint64_t>(report, "/seed", source);
  result.complete = value_at<bool>(report, "/complete", source);
  result.state_hash = value_at<std::string>(report, "/state_hash", source);
  result.goals = value_at<std::array<int, 2>>(report, "/result/score", source);
  for (std::size_t team = 0; team < colours.size(); ++team) {
    result.own_goals[team] = value_at<int>(report, fmt::format("/{}/own_goals", colours[team]), source);
    for (std::size_t column = 0; column < league_columns.size(); ++column) {
      const std::string pointer = pointer_to(team, league_columns[column]);
      if (!value_at<Json>(report, pointer, source).is_null()) {
        result.figures[team][column] = value_at<double>(report, pointer, source);
      }
    }
  }
  return result;
}

MatchResult read_match_result(const std::filesystem::path& match_json) {
  const Json report = Json::parse(host::read_file(match_json), nullptr, false);
  if (report.is_discarded()) {
    throw std::runtime_error(fmt::format("{}: is not JSON: a match.json is needed", match_json.string()));
  }
  return match_result(report, match_json.string());
}

Json json_of(const MatchResult& result) {
  Json report = {{"complete", result.complete},
                 {"state_hash", result.state_hash},
                 {"teams", result.teams},
                 {"seed", result.seed},
                 {"result", {{"score", result.goals}}}};
  for (std::size_t team = 0; team < colours.size(); ++team) {
    report[std::string(colours[team])]["own_goals"] = result.own_goals[team];
    for (std::size_t column = 0; column < league_columns.size(); ++column) {
      const std::optional<double>& figure = result.figures[team][column];
      report[Json::json_pointer(pointer_to(team, league_columns[column]))] = figure ? Json(*figure) : Json();
    }
  }
  return report;
}

}  // namespace striker::sil
