// SPDX-License-Identifier: Apache-2.0
// Numbers of fields and types: sil/match/record/proto/ssl_referee.proto.
#include "sil/match/record/ssl/ssl_game_event.hpp"

#include "sil/match/record/statistics/sides.hpp"

namespace striker::sil {
namespace {

enum class Type : std::uint8_t {
  no_progress = 2,
  touch_line = 6,
  goal_line = 7,
  goal = 8,
  attacker_at_area = 15,
  tipped_over = 27,
  defender_in_area = 31,
  boundary_crossing = 41,
};

std::uint64_t colour_of(Team team) {
  return team == Team::red ? 1 : 2;  // YELLOW, BLUE
}

ProtoMessage location(Vec2 spot) {
  ProtoMessage message;
  message.real(1, static_cast<float>(spot.x));
  message.real(2, static_cast<float>(spot.y));
  return message;
}

// The robot of the last touch, if it was one alone.
std::optional<std::size_t> only_toucher(RobotSet last_touch) {
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    if (last_touch == RobotSet().set(robot)) {
      return robot;
    }
  }
  return {};
}

ProtoMessage of_robot(Team team, std::optional<std::size_t> robot, Vec2 spot) {
  ProtoMessage message;
  message.number(1, colour_of(team));
  if (robot) {
    message.number(2, id_of(*robot));
  }
  message.message(3, location(spot));
  return message;
}

// Who touched more does not get the ball.
ProtoMessage ball_left(const MatchEvent& event) {
  return of_robot(opponent_of(*event.team), only_toucher(event.last_touch),
                  event.exit_m.value_or(event.ball.position_m));
}

ProtoMessage goal(const MatchEvent& event) {
  ProtoMessage message = of_robot(*event.team, only_toucher(event.last_touch), event.exit_m.value_or(Vec2{}));
  if (const auto kicking = only_team_of(event.last_touch)) {
    message.number(6, colour_of(*kicking));
  }
  return message;
}

ProtoMessage no_progress(const MatchEvent& event) {
  ProtoMessage message;
  message.message(1, location(event.ball.position_m));
  message.real(2, static_cast<float>(event.timer_ms) / 1e3F);
  return message;
}

ProtoMessage boundary_crossing(const MatchEvent& event) {
  ProtoMessage message;
  message.number(1, colour_of(*event.team));
  message.message(2, location(event.ball.position_m));
  return message;
}

ProtoMessage game_event(const MatchEvent& event, Type type, const ProtoMessage& what) {
  // A field's number is its type's, but for one.
  const int field = type == Type::boundary_crossing ? 43 : static_cast<int>(type);
  ProtoMessage message;
  message.message(field, what);
  message.number(40, static_cast<std::uint64_t>(type));
  message.number(49, static_cast<std::uint64_t>(event.sim_ms) * 1'000U);
  return message;
}

}  // namespace

std::optional<ProtoMessage> ssl_game_event(const MatchEvent& event) {
  switch (event.kind) {
    case EventKind::goal:
      return game_event(event, Type::goal, goal(event));
    case EventKind::ball_out:
      return game_event(event, event.cause == Cause::side_line ? Type::touch_line : Type::goal_line,
                        ball_left(event));
    case EventKind::deadlock:
      return game_event(event, Type::no_progress, no_progress(event));
    case EventKind::crowding:  // the ball is for the other team
      return game_event(event,
                        event.cause == Cause::defenders ? Type::defender_in_area : Type::attacker_at_area,
                        of_robot(opponent_of(*event.team), {}, event.ball.position_m));
    case EventKind::sent_out:
      if (event.cause == Cause::fallen) {
        return game_event(event, Type::tipped_over,
                          of_robot(*event.team, event.robot, event.ball.position_m));
      }
      if (event.cause == Cause::left_field) {
        return game_event(event, Type::boundary_crossing, boundary_crossing(event));
      }
      return {};
    default:
      return {};
  }
}

}  // namespace striker::sil
