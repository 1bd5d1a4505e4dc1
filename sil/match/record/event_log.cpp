// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/event_log.hpp"

#include <nlohmann/json.hpp>

#include "firmware/host/version.hpp"
#include "sil/match/record/match_json.hpp"

namespace striker::sil {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json name_or_null(const std::optional<T>& value) {
  return value ? Json(name_of(*value)) : Json();
}

Json members_of(RobotSet robots) {
  Json members = Json::array();
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    if (robots[robot]) {
      members.push_back(robot);
    }
  }
  return members;
}

// After a goal the other team kicks off.
std::optional<Team> owner_of(const MatchEvent& event) {
  if (event.robot || !event.team) {
    return {};
  }
  return event.kind == EventKind::goal ? opponent_of(*event.team) : *event.team;
}

// A ball that this event placed is at rest.
Json placed_or_seen_json(const MatchEvent& event, const std::array<double, 3>& velocity_m_s) {
  const std::array<double, 3> at_rest = {};
  return {{"position_m", json_of(event.ball.position_m)},
          {"height_m", event.ball.height_m},
          {"velocity_m_s", event.ball_placement ? at_rest : velocity_m_s},
          {"speed_m_s", event.ball.speed_m_s}};
}

Json placement_json(const std::optional<BallPlacement>& ball) {
  Json spot = json_of(ball ? std::optional(ball->position_m) : std::nullopt);
  if (ball) {
    spot.push_back(ball->height_m);
  }
  return spot;
}

Json event_json(const MatchEvent& event, const MatchFrame& frame) {
  return {{"seq", event.seq},
          {"t_sim_ns", event.sim_ms * 1'000'000},
          {"half", event.half},
          {"clock_ms", event.clock_ms},
          {"frame", frame.number},
          {"event", name_of(event.kind)},
          {"cause", name_of(event.cause)},
          {"team", name_or_null(event.team)},
          {"owner", name_or_null(owner_of(event))},
          {"robot", event.robot ? Json(*event.robot) : Json()},
          {"set_piece", name_or_null(event.set_piece)},
          {"score", event.score},
          {"last_touch", members_of(event.last_touch)},
          {"ball", placed_or_seen_json(event, frame.ball_velocity_m_s)},
          {"exit_m", json_of(event.exit_m)},
          {"counts", event.counts},
          {"distances_m", event.distances_m},
          {"timer_ms", event.timer_ms},
          {"robot_placement", json_of(event.robot_placement)},
          {"ball_placement", placement_json(event.ball_placement)},
          {"spot_was_taken", event.spot_was_taken}};
}

}  // namespace

void EventLog::begin(const MatchHeader& header) {
  Json line = {{"record", "striker match events"}, {"format", 1}};
  line.update(header_json(header));
  host::stamp(line);
  file_.write(line.dump() + '\n');
  file_.flush();
}

void EventLog::frame(const MatchFrame& frame) {
  for (const MatchEvent& event : frame.ruling.events) {
    file_.write(event_json(event, frame).dump() + '\n');
  }
  if (!frame.ruling.events.empty()) {
    file_.flush();
  }
}

}  // namespace striker::sil
