// SPDX-License-Identifier: Apache-2.0
#include "sil/match/referee/referee.hpp"

#include <span>
#include <stdexcept>

#include "sil/match/referee/formations.hpp"
#include "sil/match/referee/free_spot.hpp"

namespace striker::sil {
namespace {

// No frame has more: each robot is sent home, sent out, and returned at most once, its goalkeeper with each, and play
// stops at most once.
constexpr std::size_t most_events_a_frame = 4 * robots_in_match + 1;

std::array<Vec2, robots_in_match> positions_of(const RefereeFrame& frame) {
  std::array<Vec2, robots_in_match> positions;
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    positions[robot] = {frame.robots[robot].x_m, frame.robots[robot].y_m};
  }
  return positions;
}

}  // namespace

Referee::Referee(const MatchRules& rules) : rules_(rules) {
  if (!are_sound(rules)) {
    throw std::invalid_argument("the match's rules are not sound: see are_sound");
  }
  ruling_.events.reserve(most_events_a_frame);
  place_all();
  placed_ = true;
  ruling_.pause_ms = rules_.settle_ms;
}

const Ruling& Referee::step(const RefereeFrame& frame) {
  ruling_.events.clear();
  ruling_.placements = {};
  ruling_.reset_reason = ResetReason::none;
  if (ruling_.state == GameState::over) {
    return ruling_;
  }
  ruling_.sim_ms += frame_ms;
  seen_ = ruling_.half == 1 ? frame : turned(frame);
  shown_ = positions_of(seen_);
  if (ruling_.state == GameState::pause) {
    wait();
  } else {
    play();
  }
  ball_before_ = seen_.ball.position_m;
  return ruling_;
}

void Referee::play() {
  ruling_.clock_ms += frame_ms;
  if (ruling_.clock_ms >= rules_.half_ms) {
    return end_half();
  }
  if (seen_.touching.any()) {
    last_touch_ = seen_.touching;
  }
  check_fallen();
  check_field();
  check_goal_areas();
  check_keepers();
  if (ruling_.state == GameState::open_play) {
    judge_open_play();
  } else {
    judge_set_piece();
  }
}

void Referee::end_half() {
  const bool match_is_over = ruling_.half == 2;
  MatchEvent& event = tell(match_is_over ? EventKind::match_over : EventKind::half_over, Cause::time);
  event.timer_ms = ruling_.clock_ms;
  if (match_is_over) {
    ruling_.reset_reason = ResetReason::game_end;
    return stop(rules_.half_pause_ms, {.next = GameState::over});
  }
  ruling_.reset_reason = ResetReason::half_time;
  event.team = Team::blue;
  event.set_piece = GameState::kickoff;
  stop(rules_.half_pause_ms, {.owner = Team::blue});
}

void Referee::stop(int pause_ms, const Stop& how) {
  stop_ = how;
  placed_ = false;
  ruling_.pause_ms = pause_ms;
  ruling_.state = GameState::pause;
  ruling_.owner.reset();
}

void Referee::wait() {
  ruling_.pause_ms -= frame_ms;
  if (ruling_.pause_ms > 0) {
    return;
  }
  if (placed_) {
    resume();
  } else if (stop_.next == GameState::over) {
    ruling_.state = GameState::over;
  } else {
    restart();
  }
}

void Referee::restart() {
  if (stop_.cause == Cause::half_start) {
    ruling_.half = 2;
    ruling_.clock_ms = 0;
  }
  if (stop_.next == GameState::open_play) {
    drop_ball();
  } else {
    place_all();
  }
  placed_ = true;
  ruling_.pause_ms = rules_.settle_ms;
}

void Referee::place_all() {
  const LineUp line_up = line_up_of(stop_.next, stop_.owner, stop_.ball);
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    seen_.robots[robot] = line_up.robots[robot];
    ruling_.placements.robots[robot] = in_field_frame(line_up.robots[robot]);
  }
  seen_.ball = {.position_m = line_up.ball, .height_m = placed_ball_height_m};
  ruling_.placements.ball = {.position_m = in_field_frame(line_up.ball), .height_m = placed_ball_height_m};

  ruling_.sent_out.reset();
  ruling_.locked.set();
  ruling_.locked.reset(kicker_of(stop_.next, stop_.owner));
  last_touch_.reset();
  out_since_ms_ = {};
  stood_ms_.fill(ruling_.clock_ms);
  out_of_goal_area_ms_.fill(ruling_.clock_ms);
  keeper_home_ms_.fill(ruling_.clock_ms);
  ball_fast_ms_ = ruling_.clock_ms;
  set_piece_since_ms_ = ruling_.clock_ms;

  MatchEvent& event = tell(EventKind::restart, stop_.cause);
  event.team = stop_.owner;
  event.set_piece = stop_.next;
  event.ball_placement = ruling_.placements.ball;
}

void Referee::drop_ball() {
  const Vec2 wanted = drop_spot(stop_.ball);
  Vec2 spot = wanted;
  if (rules_.drop_on_free_spot) {
    const bool at_red = defenders_at(wanted) == Team::red;
    const auto robots = positions_of(at_red ? seen_ : turned(seen_));
    const Vec2 own = at_red ? wanted : turned(wanted);
    const Vec2 free = free_spot(own, robots, rules_.clearance_m, ball_reach_m).value_or(own);
    spot = at_red ? free : turned(free);
  }
  seen_.ball = {.position_m = spot, .height_m = dropped_ball_height_m};
  ruling_.placements.ball = {.position_m = in_field_frame(spot), .height_m = dropped_ball_height_m};
  ball_fast_ms_ = ruling_.clock_ms;

  MatchEvent& event = tell(EventKind::restart, stop_.cause);
  event.ball_placement = ruling_.placements.ball;
  event.spot_was_taken = spot != wanted;
}

void Referee::resume() {
  ruling_.pause_ms = 0;
  ruling_.state = stop_.next;
  ruling_.reset_reason = stop_.reason;
  MatchEvent& event = tell(EventKind::resumed, stop_.cause);
  if (is_set_piece(stop_.next)) {
    ruling_.owner = stop_.owner;
    event.team = stop_.owner;
    event.set_piece = stop_.next;
  }
}

MatchEvent& Referee::tell(EventKind kind, Cause cause) {
  MatchEvent event;
  event.seq = next_seq_++;
  event.kind = kind;
  event.cause = cause;
  event.sim_ms = ruling_.sim_ms;
  event.half = ruling_.half;
  event.clock_ms = ruling_.clock_ms;
  event.score = ruling_.score;
  event.last_touch = last_touch_;
  event.ball = seen_.ball;
  event.ball.position_m = in_field_frame(seen_.ball.position_m);
  return ruling_.events.emplace_back(event);
}

Vec2 Referee::in_field_frame(Vec2 spot) const {
  return ruling_.half == 1 ? spot : turned(spot);
}

Pose Referee::in_field_frame(const Pose& pose) const {
  return ruling_.half == 1 ? pose : turned(pose);
}

}  // namespace striker::sil
