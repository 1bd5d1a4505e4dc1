// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/match_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "firmware/host/version.hpp"
#include "sil/match/record/match_json.hpp"

namespace striker::sil {
namespace {

using Json = nlohmann::ordered_json;

double seconds(std::int64_t time_ms) {
  return static_cast<double>(time_ms) / 1e3;
}

template <class Part, class Whole>
Json share(Part part, Whole whole) {
  return whole > 0 ? Json(static_cast<double>(part) / static_cast<double>(whole)) : Json();
}

Json json_of(const SetPieces& pieces) {
  return {{"total", pieces.total()},
          {"after_out", pieces.after_out},
          {"after_crowding", pieces.after_crowding},
          {"after_deadlock", pieces.after_deadlock}};
}

Json result_json(const MatchFigures& figures, bool complete) {
  const auto [red, blue] = figures.score;
  const char* winner = red > blue ? "red" : blue > red ? "blue" : "draw";
  return {{"score", figures.score}, {"winner", complete ? Json(winner) : Json()}};
}

Json flow_json(const MatchFigures& figures) {
  const int played_ms = figures.played_ms();
  Json state_s = Json::object();
  for (std::size_t state = 0; state < game_state_names.size(); ++state) {
    state_s[std::string(game_state_names[state])] = seconds(figures.state_ms[state]);
  }
  return {{"frames", figures.frames},
          {"sim_s", seconds(figures.sim_ms)},
          {"half", figures.half},
          {"clock_s", seconds(figures.clock_ms)},
          {"played_s", seconds(played_ms)},
          {"dead_s", seconds(figures.sim_ms - played_ms)},
          {"in_play_share", share(played_ms, figures.sim_ms)},
          {"state_s", state_s},
          {"middle_third_share", share(figures.middle_third_ms, played_ms)},
          {"deadlocks", figures.deadlocks},
          {"drops", figures.drops},
          {"deadlocks_per_10_min", share(figures.deadlocks * 600'000.0, played_ms)}};
}

// Of the robots first to last - 1, as one.
struct FirmwareSum {
  FirmwareSum(const MatchFigures& figures, std::size_t first, std::size_t last) {
    for (std::size_t robot = first; robot < last; ++robot) {
      const RobotFigures& one = figures.robots[robot];
      touches += one.touches;
      play_ms += std::int64_t{one.play_frames} * frame_ms;
      undriven_ms += one.undriven_ms;
      order_age_sum_ms += one.order_age_sum_ms;
      order_frames += one.order_frames;
      order_age_max_ms = std::max(order_age_max_ms, one.order_age_max_ms);
      saturated_ticks += one.saturated_ticks;
      lost_frames += one.lost_frames;
      for (const int count : one.faults) {
        faults += count;
      }
    }
  }

  int touches = 0;
  std::int64_t play_ms = 0;  // as many ticks
  std::int64_t undriven_ms = 0;
  std::int64_t order_age_sum_ms = 0;
  int order_frames = 0;
  int order_age_max_ms = 0;
  std::int64_t saturated_ticks = 0;
  int lost_frames = 0;
  int faults = 0;
};

static_assert(core::tick_us == 1'000, "ticks are counted as milliseconds here");

Json firmware_json(const FirmwareSum& sum) {
  return {{"order_age_mean_ms", share(sum.order_age_sum_ms, sum.order_frames)},
          {"order_age_max_ms", sum.order_frames > 0 ? Json(sum.order_age_max_ms) : Json()},
          {"saturation_share", share(sum.saturated_ticks, sum.play_ms)},
          {"lost_frames", sum.lost_frames},
          {"faults", sum.faults},
          {"undriven_s", seconds(sum.undriven_ms)}};
}

Json ball_json(const MatchFigures& figures, Team team, int touches) {
  const TeamFigures& own = figures.teams[index_of(team)];
  const TeamFigures& other = figures.teams[index_of(opponent_of(team))];
  return {{"possession_s", seconds(own.possession_ms)},
          {"possession_share", share(own.possession_ms, own.possession_ms + other.possession_ms)},
          {"control_s", seconds(own.control_ms)},
          {"control_share", share(own.control_ms, own.control_ms + other.control_ms)},
          {"attacking_third_share", share(own.attacking_third_ms, figures.played_ms())},
          {"touches", touches},
          {"passes", own.passes},
          {"penalty_area_entries", own.penalty_area_entries}};
}

Json discipline_json(const TeamFigures& team) {
  return {{"sent_out", team.fallen + team.left_field + team.keeper_sent_out},
          {"fallen", team.fallen},
          {"left_field", team.left_field},
          {"keeper_sent_out", team.keeper_sent_out},
          {"sent_home", team.sent_home},
          {"keeper_sent_home", team.keeper_sent_home},
          {"out_s", seconds(team.out_ms)}};
}

Json team_json(const std::string& name, const MatchFigures& figures, Team team) {
  const TeamFigures& own = figures.teams[index_of(team)];
  const TeamFigures& other = figures.teams[index_of(opponent_of(team))];
  const FirmwareSum sum(figures, robot_of(team, 0), robot_of(team, 0) + robots_a_team);
  return {{"name", name},
          {"goals", own.goals},
          {"own_goals", own.own_goals},
          {"orders", {{"asked_frames", own.asked_frames}, {"unanswered_frames", own.unanswered_frames}}},
          {"ball", ball_json(figures, team, sum.touches)},
          {"attack",
           {{"shots", own.shots},
            {"shots_on_target", own.shots_on_target},
            {"conversion", share(own.goals - other.own_goals, own.shots)},
            {"kicks", own.kicks},
            {"kicks_met", own.kicks_met},
            {"kicks_as_meant", own.kicks_as_meant},
            {"kicks_as_meant_share", share(own.kicks_as_meant, own.kicks_met)}}},
          {"keeper",
           {{"saves", own.saves},
            {"line_m", share(own.keeper_line_sum_m, own.keeper_frames)},
            {"lag_m", share(own.keeper_lag_sum_m, own.keeper_frames)}}},
          {"goal_kicks", json_of(own.goal_kicks)},
          {"corners", json_of(own.corners)},
          {"penalties", json_of(own.penalties)},
          {"discipline", discipline_json(own)},
          {"firmware", firmware_json(sum)}};
}

Json robot_json(const MatchFigures& figures, std::size_t robot) {
  const RobotFigures& one = figures.robots[robot];
  const FirmwareSum sum(figures, robot, robot + 1);
  Json row = {{"team", name_of(team_of(robot))},
              {"id", id_of(robot)},
              {"touches", one.touches},
              {"way_m", one.way_m},
              {"play_s", seconds(sum.play_ms)}};
  row.update(firmware_json(sum));
  Json faults = Json::object();
  for (std::size_t fault = 0; fault < one.faults.size(); ++fault) {
    if (one.faults[fault] > 0) {
      faults[std::string(core::fault_names[fault])] = one.faults[fault];
    }
  }
  row["faults"] = faults;
  return row;
}

}  // namespace

Json match_json(const MatchHeader& header, const MatchFigures& figures, const MatchEnd& end) {
  Json report = {{"record", "striker match"},
                 {"format", 1},
                 {"complete", end.complete},
                 {"state_hash", fmt::format("{:016x}", end.state_hash)}};
  report.update(header_json(header));
  report["result"] = result_json(figures, end.complete);
  report["flow"] = flow_json(figures);
  for (const Team team : teams) {
    report[std::string(name_of(team))] = team_json(header.teams[index_of(team)], figures, team);
  }
  Json robots = Json::array();
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    robots.push_back(robot_json(figures, robot));
  }
  report["robots"] = robots;
  host::stamp(report);
  return report;
}

void MatchReport::end(const MatchEnd& end) {
  file_.write(match_json(header_, statistics_.figures(), end).dump(1) + '\n');
  file_.finish();
}

}  // namespace striker::sil
