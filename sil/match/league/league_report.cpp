// SPDX-License-Identifier: Apache-2.0
#include "sil/match/league/league_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "firmware/host/files.hpp"
#include "firmware/host/version.hpp"

namespace striker::sil {
namespace {

using Json = nlohmann::ordered_json;

// Without the sign of what rounds to 0.
double hundredths(double value) {
  return std::abs(value) < 0.005 ? 0.0 : value;
}

std::string text_of(const Mean& mean, int values) {
  if (values == 0) {
    return "-";
  }
  return mean.half_width ? fmt::format("{:+.2f} +- {:.2f}", hundredths(mean.value), *mean.half_width)
                         : fmt::format("{:+.2f}", hundredths(mean.value));
}

std::string text_of(const Share& share) {
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", share.value, share.low, share.high);
}

std::string text_of(const LeagueRecord& record) {
  return fmt::format("{} | {} | {} | {} | {}:{}", record.played, record.won, record.drawn, record.lost,
                     record.goals_for, record.goals_against);
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : "";
}

std::string cells_of(const LeagueRecord& record) {
  return fmt::format("{},{},{},{},{},{}", record.played, record.won, record.drawn, record.lost,
                     record.goals_for, record.goals_against);
}

std::string cells_of(const Mean& mean, int values) {
  return fmt::format("{},{}", values > 0 ? cell(mean.value) : "", cell(mean.half_width));
}

std::string cells_of(const Share& share) {
  return fmt::format("{:.6g},{:.6g},{:.6g}", share.value, share.low, share.high);
}

Json json_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

void add(Json& row, const LeagueRecord& record) {
  row["played"] = record.played;
  row["won"] = record.won;
  row["drawn"] = record.drawn;
  row["lost"] = record.lost;
  row["goals_for"] = record.goals_for;
  row["goals_against"] = record.goals_against;
}

void add(Json& row, const Mean& mean, int values) {
  row["goal_difference"] = values > 0 ? Json(mean.value) : Json();
  row["goal_difference_half_width"] = json_or_null(mean.half_width);
}

void add(Json& row, const Share& share) {
  row["win_share"] = share.value;
  row["win_share_low"] = share.low;
  row["win_share_high"] = share.high;
}

Json json_of(const LeagueRow& team, std::size_t place) {
  Json row = {{"place", place}, {"team", team.team}};
  add(row, team.record);
  row["own_goals"] = team.own_goals;
  row["points"] = team.record.points();
  row["pairs"] = team.pairs;
  add(row, team.goal_difference, team.pairs);
  add(row, team.win_share);
  for (std::size_t column = 0; column < league_columns.size(); ++column) {
    row["figures"][std::string(league_columns[column].name)] = json_or_null(team.figures[column]);
  }
  return row;
}

Json json_of(const LeaguePairing& pairing) {
  Json row = {{"first", pairing.first}, {"second", pairing.second}};
  add(row, pairing.record);
  row["pairs"] = pairing.pairs;
  add(row, pairing.goal_difference, pairing.pairs);
  add(row, pairing.win_share);
  return row;
}

Json json_of(const LeagueMirror& mirror) {
  Json row = {{"team", mirror.team}};
  add(row, mirror.record);
  add(row, mirror.goal_difference, mirror.record.played);
  return row;
}

std::string mirrors_markdown(const LeagueTable& table) {
  std::string text =
      "\nAgainst themselves, as red sees it: a control, whose difference should be 0.\n\n"
      "| team | played | won | drawn | lost | goals | difference a match |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const LeagueMirror& mirror : table.mirrors) {
    text += fmt::format("| {} | {} | {} |\n", mirror.team, text_of(mirror.record),
                        text_of(mirror.goal_difference, mirror.record.played));
  }
  return text;
}

// A column a team: there are many figures.
std::string figures_markdown(const LeagueTable& table) {
  std::string text = "\nStatistics, means a match.\n\n| statistic |";
  std::string line = "|---|";
  for (const LeagueRow& row : table.rows) {
    text += fmt::format(" {} |", row.team);
    line += "---|";
  }
  text += '\n' + line + '\n';
  for (std::size_t column = 0; column < league_columns.size(); ++column) {
    text += fmt::format("| {} |", league_columns[column].name);
    for (const LeagueRow& row : table.rows) {
      text += row.figures[column] ? fmt::format(" {:.3g} |", *row.figures[column]) : std::string(" - |");
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string league_markdown(const LeagueTable& table) {
  std::string text = fmt::format(
      "{} matches{}. Differences of goals a match, each two teams playing each seed twice with colours swapped: means "
      "with 95 % intervals over such pairs. Shares of wins with 95 % intervals.\n\n"
      "| place | team | played | won | drawn | lost | goals | own goals | points | difference a match | share of wins |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n",
      table.matches, table.incomplete > 0 ? fmt::format("; {} more were interrupted", table.incomplete) : "");
  for (std::size_t place = 0; place < table.rows.size(); ++place) {
    const LeagueRow& row = table.rows[place];
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", place + 1, row.team, text_of(row.record),
                        row.own_goals, row.record.points(), text_of(row.goal_difference, row.pairs),
                        text_of(row.win_share));
  }
  text +=
      "\n| first | second | played | won | drawn | lost | goals | pairs | difference a match | share of wins |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const LeaguePairing& pairing : table.pairings) {
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", pairing.first, pairing.second,
                        text_of(pairing.record), pairing.pairs,
                        text_of(pairing.goal_difference, pairing.pairs), text_of(pairing.win_share));
  }
  return text + (table.mirrors.empty() ? "" : mirrors_markdown(table)) + figures_markdown(table);
}

std::string league_csv(const LeagueTable& table) {
  std::string csv =
      "place,team,played,won,drawn,lost,goals_for,goals_against,own_goals,points,pairs,goal_difference,"
      "goal_difference_half_width,win_share,win_share_low,win_share_high";
  for (const LeagueColumn& column : league_columns) {
    csv += fmt::format(",{}", column.name);
  }
  csv += '\n';
  for (std::size_t place = 0; place < table.rows.size(); ++place) {
    const LeagueRow& row = table.rows[place];
    csv += fmt::format("{},{},{},{},{},{},{},{}", place + 1, row.team, cells_of(row.record), row.own_goals,
                       row.record.points(), row.pairs, cells_of(row.goal_difference, row.pairs),
                       cells_of(row.win_share));
    for (const std::optional<double>& figure : row.figures) {
      csv += ',' + cell(figure);
    }
    csv += '\n';
  }
  return csv;
}

std::string pairings_csv(const LeagueTable& table) {
  std::string csv =
      "first,second,played,won,drawn,lost,goals_for,goals_against,pairs,goal_difference,goal_difference_half_width,"
      "win_share,win_share_low,win_share_high\n";
  for (const LeaguePairing& pairing : table.pairings) {
    csv += fmt::format("{},{},{},{},{},{}\n", pairing.first, pairing.second, cells_of(pairing.record),
                       pairing.pairs, cells_of(pairing.goal_difference, pairing.pairs),
                       cells_of(pairing.win_share));
  }
  return csv;
}

Json league_json(const LeagueTable& table) {
  Json report = {{"record", "striker league"}, {"format", 1},
                 {"matches", table.matches},   {"incomplete", table.incomplete},
                 {"teams", Json::array()},     {"pairings", Json::array()},
                 {"mirrors", Json::array()}};
  for (std::size_t place = 0; place < table.rows.size(); ++place) {
    report["teams"].push_back(json_of(table.rows[place], place + 1));
  }
  for (const LeaguePairing& pairing : table.pairings) {
    report["pairings"].push_back(json_of(pairing));
  }
  for (const LeagueMirror& mirror : table.mirrors) {
    report["mirrors"].push_back(json_of(mirror));
  }
  host::stamp(report);
  return report;
}

void write_league(const LeagueTable& table, const std::filesystem::path& directory) {
  host::require_writable(directory);
  host::write_file(directory / "league.md", league_markdown(table));
  host::write_file(directory / "league.csv", league_csv(table));
  host::write_file(directory / "pairings.csv", pairings_csv(table));
  host::write_file(directory / "league.json", league_json(table).dump(1) + '\n');
}

}  // namespace striker::sil
