// SPDX-License-Identifier: Apache-2.0
#include "sil/match/league/match_result.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "firmware/host/files.hpp"

namespace striker::sil {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 2> colours = {"red", "blue"};

[[noreturn]] void fail(std::string_view source, const std::string& pointer, const Json& value) {
  throw std::runtime_error(
      fmt::format("{}: {} is {}, which it cannot be: a match.json of this version is needed", source, pointer,
                  value.dump()));
}

const Json& value_at(const Json& report, const std::string& pointer, std::string_view source) {
  const Json::json_pointer place(pointer);
  if (!report.contains(place)) {
    throw std::runtime_error(
        fmt::format("{}: {} is missing: a match.json of this version is needed", source, pointer));
  }
  return report.at(place);
}

template <class T>
T value_at(const Json& report, const std::string& pointer, std::string_view source) {
  const Json& value = value_at(report, pointer, source);
  try {
    return value.get<T>();
  } catch (const Json::exception&) {
    fail(source, pointer, value);
  }
}

// Nothing that JSON would turn into one: no 9.7, no true.
int count_at(const Json& report, const std::string& pointer, std::string_view source) {
  constexpr std::int64_t most = 1'000'000;  // more than frames in a match
  const Json& value = value_at(report, pointer, source);
  if (!value.is_number_integer() || value.get<std::int64_t>() < 0 || value.get<std::int64_t>() > most) {
    fail(source, pointer, value);
  }
  return value.get<int>();
}

bool is_hash(std::string_view text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

// By its name: shares are from 0 to 1, what has a unit is not negative, and all else is counted.
bool may_be(const LeagueColumn& column, const Json& value) {
  const std::string_view name = column.name;
  if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < 0.0) {
    return false;
  }
  if (name.ends_with("_share") || name == "conversion") {
    return value.get<double>() <= 1.0;
  }
  const bool has_unit = name.ends_with("_m") || name.ends_with("_s") || name.ends_with("_ms");
  return has_unit || value.get<double>() == std::floor(value.get<double>());
}

std::optional<double> figure_at(const Json& report, const std::string& pointer, const LeagueColumn& column,
                                std::string_view source) {
  const Json& value = value_at(report, pointer, source);
  if (value.is_null()) {
    return std::nullopt;
  }
  if (!may_be(column, value)) {
    fail(source, pointer, value);
  }
  return value.get<double>();
}

std::string pointer_to(std::size_t team, const LeagueColumn& column) {
  return fmt::format("/{}{}", colours[team], column.pointer);
}

}  // namespace

MatchResult match_result(const Json& report, std::string_view source) {
  MatchResult result;
  for (const char* pair : {"/teams", "/result/score"}) {
    if (const Json& value = value_at(report, pair, source); !value.is_array() || value.size() != 2) {
      fail(source, pair, value);
    }
  }
  result.teams = value_at<std::array<std::string, 2>>(report, "/teams", source);
  if (const Json& seed = value_at(report, "/seed", source); !seed.is_number_unsigned()) {
    fail(source, "/seed", seed);
  }
  result.seed = value_at<std::uint64_t>(report, "/seed", source);
  result.complete = value_at<bool>(report, "/complete", source);
  result.state_hash = value_at<std::string>(report, "/state_hash", source);
  if (!is_hash(result.state_hash)) {
    fail(source, "/state_hash", result.state_hash);
  }
  for (std::size_t team = 0; team < colours.size(); ++team) {
    result.goals[team] = count_at(report, fmt::format("/result/score/{}", team), source);
  }
  for (std::size_t team = 0; team < colours.size(); ++team) {
    const std::string own_goals = fmt::format("/{}/own_goals", colours[team]);
    result.own_goals[team] = count_at(report, own_goals, source);
    if (result.own_goals[team] > result.goals[1 - team]) {
      fail(source, own_goals, result.own_goals[team]);
    }
    for (std::size_t column = 0; column < league_columns.size(); ++column) {
      result.figures[team][column] =
          figure_at(report, pointer_to(team, league_columns[column]), league_columns[column], source);
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
