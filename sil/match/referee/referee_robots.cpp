// SPDX-License-Identifier: Apache-2.0
// What robots may not do, each by itself: steps 3 to 6 of a frame, and who returns.
#include <algorithm>

#include "sil/match/referee/areas.hpp"
#include "sil/match/referee/formations.hpp"
#include "sil/match/referee/free_spot.hpp"
#include "sil/match/referee/referee.hpp"

namespace striker::sil {

void Referee::check_fallen() {
  const RobotSet judged = active();
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    const int down_ms = ruling_.clock_ms - stood_ms_[robot];
    if (judged[robot] && down_ms >= rules_.fallen_ms) {
      send_out(robot, Cause::fallen, down_ms);
    } else if (seen_.standing[robot]) {
      stood_ms_[robot] = ruling_.clock_ms;
    }
  }
}

void Referee::check_field() {
  const RobotSet judged = active();
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    if (judged[robot] && has_left_field(own_position(robot))) {
      send_out(robot, Cause::left_field, 0);
    }
  }
}

void Referee::check_goal_areas() {
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    if (!in_opponents_goal_area(own_position(robot))) {
      out_of_goal_area_ms_[robot] = ruling_.clock_ms;
      continue;
    }
    const int inside_ms = ruling_.clock_ms - out_of_goal_area_ms_[robot];
    if (inside_ms >= rules_.goal_area_ms && is_home_free(robot)) {
      send_home(robot, Cause::goal_area, inside_ms);
      out_of_goal_area_ms_[robot] = ruling_.clock_ms;
      send_out(robot_of(team_of(robot), goalkeeper_id), Cause::goal_area, inside_ms);
    }
  }
}

void Referee::check_keepers() {
  for (const Team team : teams) {
    const std::size_t keeper = robot_of(team, goalkeeper_id);
    if (!active()[keeper]) {
      continue;
    }
    int& home_ms = keeper_home_ms_[index_of(team)];
    const int away_ms = ruling_.clock_ms - home_ms;
    if (keeper_is_home(own_position(keeper))) {
      home_ms = ruling_.clock_ms;
    } else if (away_ms >= rules_.keeper_away_ms && is_home_free(keeper)) {
      send_home(keeper, Cause::keeper_away, away_ms);
      home_ms = ruling_.clock_ms;
    }
  }
}

void Referee::return_robots() {
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    const int out_ms = ruling_.clock_ms - out_since_ms_[robot].value_or(ruling_.clock_ms);
    if (out_ms < rules_.sent_out_ms || !is_home_free(robot)) {
      continue;
    }
    ruling_.sent_out.reset(robot);
    out_since_ms_[robot].reset();
    stood_ms_[robot] = ruling_.clock_ms;  // it is put on its wheels, whatever was seen of it out there
    place(robot, home_spot(id_of(robot)));
    MatchEvent& event = tell(EventKind::returned, Cause::time);
    event.team = team_of(robot);
    event.robot = robot;
    event.timer_ms = out_ms;
    event.robot_placement = ruling_.placements.robots[robot];
  }
}

void Referee::send_out(std::size_t robot, Cause cause, int timer_ms) {
  const EventKind kind = ruling_.sent_out[robot] ? EventKind::out_anew : EventKind::sent_out;
  ruling_.sent_out.set(robot);
  out_since_ms_[robot] = ruling_.clock_ms;
  place(robot, slot(id_of(robot)));
  MatchEvent& event = tell(kind, cause);
  event.team = team_of(robot);
  event.robot = robot;
  event.timer_ms = timer_ms;
  event.robot_placement = ruling_.placements.robots[robot];
}

void Referee::send_home(std::size_t robot, Cause cause, int timer_ms) {
  place(robot, home_spot(id_of(robot)));
  MatchEvent& event = tell(EventKind::sent_home, cause);
  event.team = team_of(robot);
  event.robot = robot;
  event.timer_ms = timer_ms;
  event.robot_placement = ruling_.placements.robots[robot];
}

void Referee::place(std::size_t robot, const Pose& own_spot) {
  seen_.robots[robot] = team_of(robot) == Team::red ? own_spot : turned(own_spot);
  ruling_.placements.robots[robot] = in_field_frame(seen_.robots[robot]);
}

bool Referee::is_home_free(std::size_t robot) const {
  const Pose home = home_spot(id_of(robot));
  const Vec2 spot = team_of(robot) == Team::red ? Vec2{home.x_m, home.y_m} : turned(Vec2{home.x_m, home.y_m});
  std::array<Vec2, robots_in_match> others = shown_;
  others[robot] = seen_.ball.position_m;  // nobody is in its own way
  return is_free(spot, others, rules_.clearance_m);
}

Vec2 Referee::own_position(std::size_t robot) const {
  const Vec2 position = {seen_.robots[robot].x_m, seen_.robots[robot].y_m};
  return team_of(robot) == Team::red ? position : turned(position);
}

}  // namespace striker::sil
