// SPDX-License-Identifier: Apache-2.0
// What holds after every frame of every match, whatever was seen. An account of its own: nothing here asks the
// referee how it decides.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sil/match/referee/areas.hpp"
#include "sil/match/referee/formations.hpp"
#include "sil/match/referee/free_spot.hpp"
#include "sil/match/referee/referee.hpp"

namespace striker::sil {

class RefereeWatch {
 public:
  explicit RefereeWatch(const Referee& referee) : rules_(referee.rules()), before_(referee.ruling()) {
    look_at_events(before_);
  }

  // The first promise that this ruling on this frame breaks; empty if it keeps them all.
  std::string_view watch(const RefereeFrame& frame, const Ruling& ruling) {
    broken_ = {};
    look_at_clocks(ruling);
    look_at_state(ruling);
    look_at_flags(ruling);
    look_at_goals(frame, ruling);
    look_at_placements(frame, ruling);
    look_at_events(ruling);
    before_ = ruling;
    return broken_;
  }

 private:
  void hold(bool holds, std::string_view promise) {
    if (!holds && broken_.empty()) {
      broken_ = promise;
    }
  }
  [[nodiscard]] static const MatchEvent* find(const Ruling& ruling, EventKind kind) {
    for (const MatchEvent& event : ruling.events) {
      if (event.kind == kind) {
        return &event;
      }
    }
    return nullptr;
  }
  [[nodiscard]] static bool has(const Ruling& ruling, EventKind kind) {
    return find(ruling, kind) != nullptr;
  }

  void look_at_clocks(const Ruling& now) {
    const bool is_over = before_.state == GameState::over;
    hold(now.sim_ms == before_.sim_ms + (is_over ? 0 : frame_ms), "simulated time goes on until the end");
    hold(now.half == before_.half || (now.half == 2 && now.clock_ms == 0), "the second half begins at 0");
    hold(now.clock_ms >= 0 && now.clock_ms <= rules_.half_ms, "the clock is of the half");
    if (now.half == before_.half) {
      const bool runs = before_.state != GameState::pause && !is_over;
      hold(now.clock_ms == before_.clock_ms + (runs ? frame_ms : 0), "the clock runs in play alone");
    }
    const bool time_is_up = now.clock_ms == rules_.half_ms;
    hold(!time_is_up || now.state == GameState::pause || now.state == GameState::over,
         "no play after the time");
  }

  void look_at_state(const Ruling& now) {
    hold(now.state <= GameState::over, "a state is one of its values");
    hold(now.reset_reason <= ResetReason::half_time, "a reason is one of its values");
    hold(now.owner.has_value() == is_set_piece(now.state), "a set piece alone has an owner");
    hold((now.pause_ms > 0) == (now.state == GameState::pause) && now.pause_ms % frame_ms == 0,
         "a pause alone has time left");
    const bool paused = before_.state == GameState::pause;
    hold(now.state == before_.state || now.state == GameState::pause || paused ||
             (is_set_piece(before_.state) && now.state == GameState::open_play),
         "play goes from a set piece into open play, and else through a pause");
    hold(before_.state != GameState::over || (now.state == GameState::over && now.events.empty()),
         "a match that is over stays so");
    hold(now.reset_reason == ResetReason::none || (paused && now.state != GameState::pause) ||
             now.clock_ms == rules_.half_ms,
         "a reason is told when play goes on, or the time is up");
  }

  void look_at_flags(const Ruling& now) {
    if (is_set_piece(now.state)) {
      RobotSet others = RobotSet().set();
      others.reset(kicker_of(now.state, *now.owner));
      hold(now.locked == others, "in a set piece all but the kicker are locked");
    }
    hold(now.state != GameState::open_play || now.locked.none(), "nobody is locked in open play");
    RobotSet expected = before_.sent_out;
    for (const MatchEvent& event : now.events) {
      if (event.kind == EventKind::sent_out || event.kind == EventKind::out_anew) {
        hold(expected[*event.robot] == (event.kind == EventKind::out_anew), "who is sent out was not out");
        expected.set(*event.robot);
        out_ms_[*event.robot] = now.clock_ms;
      } else if (event.kind == EventKind::returned) {
        hold(now.clock_ms - out_ms_[*event.robot] >= rules_.sent_out_ms, "who returns was out for its time");
        expected.reset(*event.robot);
      } else if ((event.kind == EventKind::restart && event.cause != Cause::drop) ||
                 (event.kind == EventKind::set_piece_over && !rules_.own_flag_for_sent_out)) {
        expected.reset();
      }
    }
    hold(now.sent_out == expected, "who is out is what the events say");
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      const bool plays = now.state != GameState::pause && now.state != GameState::over;
      hold(now.may_move(robot) == (plays && !now.locked[robot] && !now.sent_out[robot]),
           "nobody moves who may not");
    }
  }

  void look_at_goals(const RefereeFrame& frame, const Ruling& now) {
    const Vec2 ball = now.half == 1 ? frame.ball.position_m : turned(frame.ball.position_m);
    const bool scores = before_.state == GameState::open_play && now.clock_ms < rules_.half_ms &&
                        std::abs(ball.x) > 3.9 && std::abs(ball.y) < 0.5;
    std::array<int, 2> score = before_.score;
    if (scores) {
      ++score[ball.x > 0.0 ? 0 : 1];
    }
    hold(now.score == score, "the score counts goals in open play, for who plays to that end");
    hold(has(now, EventKind::goal) == scores, "a goal is an event");
  }

  void look_at_placements(const RefereeFrame& frame, const Ruling& now) {
    std::array<Vec2, robots_in_match> robots;
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      const Pose pose = now.placements.robots[robot].value_or(frame.robots[robot]);
      robots[robot] = {pose.x_m, pose.y_m};
    }
    const auto& ball = now.placements.ball;
    if (ball) {
      hold(is_clear_of_walls(ball->position_m, ball_reach_m), "a ball is placed in the field");
      hold(!rules_.drop_on_free_spot || is_free(ball->position_m, robots, 0.155),
           "a ball is placed onto nobody");
    }
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      // As published the end of a set piece may free a robot in the frame that sends it out.
      const bool goes_out =
          now.sent_out[robot] || (!rules_.own_flag_for_sent_out && std::abs(robots[robot].x) == 4.05);
      if (!now.placements.robots[robot] || goes_out) {
        continue;
      }
      hold(std::abs(robots[robot].x) <= 3.8 && std::abs(robots[robot].y) <= 2.2,
           "a robot is placed in the field");
      std::array<Vec2, robots_in_match> others = robots;
      others[robot] = ball ? ball->position_m : frame.ball.position_m;
      hold(is_free(robots[robot], others, 0.2), "a robot is placed onto nobody");
    }
  }

  void look_at_events(const Ruling& now) {
    std::array<int, 2> score = before_.score;
    for (const MatchEvent& event : now.events) {
      score[0] += event.kind == EventKind::goal && event.team == Team::red ? 1 : 0;
      score[1] += event.kind == EventKind::goal && event.team == Team::blue ? 1 : 0;
      hold(event.seq == next_seq_++, "events are numbered one after another");
      hold(event.sim_ms == now.sim_ms && event.clock_ms == now.clock_ms && event.half == now.half,
           "an event has both clocks");
      hold(event.score == score, "an event has the score after it");
      hold(event.kind <= EventKind::returned && event.cause <= Cause::keeper_away,
           "an event has a kind and a cause");
      if (event.kind <= EventKind::match_over) {
        hold(now.state == GameState::pause && !stopped_ms_, "a stop begins a pause");
        stopped_ms_ = now.sim_ms;
        pause_ms_ = event.kind == EventKind::goal ? rules_.goal_pause_ms
                    : event.kind == EventKind::half_over || event.kind == EventKind::match_over
                        ? rules_.half_pause_ms
                        : rules_.stop_pause_ms;
      } else if (event.kind == EventKind::restart) {
        hold(now.sim_ms == stopped_ms_.value_or(0) + pause_ms_, "a pause is as long as its rule");
        restarted_ms_ = now.sim_ms;
      } else if (event.kind == EventKind::resumed) {
        hold(now.sim_ms == restarted_ms_ + rules_.settle_ms, "all settle before play goes on");
        stopped_ms_.reset();
      }
    }
  }

  MatchRules rules_;
  Ruling before_;
  std::string_view broken_;
  std::array<int, robots_in_match> out_ms_ = {};
  std::uint32_t next_seq_ = 0;
  std::optional<std::int64_t> stopped_ms_;
  std::int64_t restarted_ms_ = 0;
  int pause_ms_ = 0;
};

// All of a ruling in one number, to the bit.
class RulingDigest {
 public:
  static std::uint64_t of(const Ruling& ruling) {
    RulingDigest digest;
    digest.add(ruling.score[0], ruling.score[1], ruling.half, ruling.clock_ms, ruling.sim_ms, ruling.state,
               ruling.locked.to_ulong(), ruling.sent_out.to_ulong(), ruling.pause_ms, ruling.reset_reason);
    digest.add(ruling.owner);
    for (const auto& robot : ruling.placements.robots) {
      digest.add(robot);
    }
    digest.add(ruling.placements.ball);
    for (const MatchEvent& event : ruling.events) {
      digest.add(event.seq, event.kind, event.cause, event.sim_ms, event.half, event.clock_ms, event.score[0],
                 event.score[1], event.team, event.robot, event.set_piece, event.last_touch.to_ulong());
      digest.add(event.counts[0], event.counts[1], event.distances_m[0], event.distances_m[1], event.timer_ms,
                 event.ball.position_m, event.ball.height_m, event.ball.speed_m_s, event.exit_m,
                 event.robot_placement, event.ball_placement, event.spot_was_taken);
    }
    return digest.value_;
  }

 private:
  void add_one(double value) { mix(std::bit_cast<std::uint64_t>(value)); }
  void add_one(const Vec2& value) { add(value.x, value.y); }
  void add_one(const Pose& value) { add(value.x_m, value.y_m, value.heading_rad); }
  void add_one(const BallPlacement& value) { add(value.position_m, value.height_m); }
  template <typename T>
  void add_one(const std::optional<T>& value) {
    add(value.has_value());
    if (value) {
      add(*value);
    }
  }
  template <typename T>
  requires std::is_integral_v<T> || std::is_enum_v<T>
  void add_one(T value) { mix(static_cast<std::uint64_t>(value)); }
  template <typename... Ts>
  void add(const Ts&... values) {
    (add_one(values), ...);
  }
  void mix(std::uint64_t value) { value_ = std::rotl((value_ ^ value) * 0x9E37'79B9'7F4A'7C15, 29); }

  std::uint64_t value_ = 1;
};

}  // namespace striker::sil
