// SPDX-License-Identifier: Apache-2.0
// Numbers of fields: sil/match/record/proto/ssl_referee.proto.
#include "sil/match/record/ssl/ssl_referee.hpp"

#include "sil/match/record/ssl/ssl_game_event.hpp"

namespace striker::sil {
namespace {

std::uint64_t microseconds(std::int64_t time_ms) {
  return static_cast<std::uint64_t>(time_ms) * 1'000U;
}

ProtoMessage team_info(Team team, const MatchHeader& header, const Ruling& ruling) {
  const auto out = (ruling.sent_out & robots_of(team)).count();
  ProtoMessage info;
  info.text(1, header.teams[index_of(team)]);
  info.number(2, static_cast<std::uint64_t>(ruling.score[index_of(team)]));
  info.number(3, 0);  // red_cards
  info.number(5, 0);  // yellow_cards
  info.number(6, 0);  // timeouts
  info.number(7, 0);  // timeout_time
  info.number(8, goalkeeper_id);
  info.number(13, robots_a_team - out);  // max_allowed_bots
  return info;
}

}  // namespace

std::uint64_t SslReferee::Issued::number() const {
  const bool is_of_a_team = command >= Command::prepare_kickoff;
  return static_cast<std::uint64_t>(command) + (is_of_a_team && team == Team::blue ? 1U : 0U);
}

void SslReferee::add(const Ruling& ruling) {
  for (const MatchEvent& event : ruling.events) {
    add_event(event);
  }
}

void SslReferee::add_event(const MatchEvent& event) {
  if (auto game_event = ssl_game_event(event)) {
    game_events_.push_back(std::move(*game_event));
  }
  switch (event.kind) {
    case EventKind::goal:
    case EventKind::ball_out:
    case EventKind::crowding:
    case EventKind::deadlock:
    case EventKind::half_over:
    case EventKind::match_over:
      return stopped(event);
    case EventKind::restart:
      return placed(event);
    case EventKind::resumed:
      return resumed(event);
    default:
      return;
  }
}

void SslReferee::issue(const Issued& what, std::int64_t sim_ms) {
  command_ = what;
  next_.reset();
  ++issued_;
  issued_ms_ = sim_ms;
}

void SslReferee::stopped(const MatchEvent& event) {
  issue({.command = Command::halt}, event.sim_ms);
  if (event.kind == EventKind::match_over) {
    stage_ = Stage::post_game;
  } else if (event.kind == EventKind::half_over) {
    stage_ = Stage::half_time;
  } else if (!event.set_piece) {
    next_ = {.command = Command::force_start};
  }
  if (event.set_piece && event.team) {
    const Team owner = event.kind == EventKind::goal ? opponent_of(*event.team) : *event.team;
    next_ = {.command = event.set_piece == GameState::kickoff   ? Command::prepare_kickoff
                        : event.set_piece == GameState::penalty ? Command::prepare_penalty
                                                                : Command::direct_free,
             .team = owner};
  }
}

void SslReferee::placed(const MatchEvent& event) {
  const Team owner = event.team.value_or(Team::red);
  if (event.cause == Cause::half_start) {
    stage_ = event.half == 1 ? Stage::first_half_pre : Stage::second_half_pre;
  }
  if (event.set_piece == GameState::kickoff || event.set_piece == GameState::penalty) {
    const bool is_kickoff = event.set_piece == GameState::kickoff;
    issue({.command = is_kickoff ? Command::prepare_kickoff : Command::prepare_penalty, .team = owner},
          event.sim_ms);
    next_ = {.command = Command::normal_start};
    return;
  }
  issue({.command = Command::stop}, event.sim_ms);
  next_ = {.command = event.cause == Cause::drop ? Command::force_start : Command::direct_free,
           .team = owner};
}

void SslReferee::resumed(const MatchEvent& event) {
  stage_ = event.half == 1 ? Stage::first_half : Stage::second_half;
  issue(next_.value_or(Issued{.command = Command::force_start}), event.sim_ms);
  game_events_.clear();
}

std::string SslReferee::packet(const Ruling& ruling) const {
  ProtoMessage message;
  message.number(1, microseconds(ruling.sim_ms));
  message.number(2, static_cast<std::uint64_t>(stage_));
  if (stage_ == Stage::first_half || stage_ == Stage::second_half) {
    message.zigzag(3, std::int64_t{header_.rules.half_ms - ruling.clock_ms} * 1'000);
  }
  message.number(4, command_.number());
  message.number(5, issued_);
  message.number(6, microseconds(issued_ms_));
  message.message(7, team_info(Team::red, header_, ruling));
  message.message(8, team_info(Team::blue, header_, ruling));
  // Stages before a half belong to the sides of that half; those of half-time to the first's.
  message.number(10, ruling.half == 1 ? 1 : 0);
  if (next_) {
    message.number(12, next_->number());
  }
  for (const ProtoMessage& event : game_events_) {
    message.message(16, event);
  }
  message.text(18, "striker");  // source_identifier
  return message.bytes();
}

}  // namespace striker::sil
