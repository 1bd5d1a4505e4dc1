// SPDX-License-Identifier: Apache-2.0
// A match's rulings as SSL's referee message. Red is yellow, blue is blue.
//
//   here                                    command                              stage
//   a stop, the end of a half               HALT, with the next command          as it was; NORMAL_HALF_TIME; POST_GAME
//   placed for a kickoff, a penalty kick    PREPARE_KICKOFF_x, PREPARE_PENALTY_x before a half's first: ..._HALF_PRE
//   placed for a goal kick or corner kick   STOP, next DIRECT_FREE_x
//   the ball is dropped                     STOP, next FORCE_START
//   the clock runs on                       NORMAL_START, DIRECT_FREE_x, FORCE_START    NORMAL_..._HALF
//
// Game events since play last ran: goal, ball out (a corner's cut counts as goal line), deadlock as no progress,
// crowding as a defender in or an attacker at the defence area, fallen as tipped over, left field as boundary crossing.
// What else sends robots out or home has none in SSL.
#pragma once

#include <string>
#include <vector>

#include "sil/match/record/match_frame.hpp"
#include "sil/match/record/ssl/proto_message.hpp"

namespace striker::sil {

class SslReferee {
 public:
  void begin(const MatchHeader& header) { header_ = header; }
  void add(const Ruling& ruling);

  // Referee, after the ruling that was added last.
  [[nodiscard]] std::string packet(const Ruling& ruling) const;

 private:
  // By SSL's numbers; those of a team are yellow's, and blue's are one more.
  enum class Command : std::uint8_t {
    halt = 0,
    stop = 1,
    normal_start = 2,
    force_start = 3,
    prepare_kickoff = 4,
    prepare_penalty = 6,
    direct_free = 8,
  };
  enum class Stage : std::uint8_t {
    first_half_pre = 0,
    first_half = 1,
    half_time = 2,
    second_half_pre = 3,
    second_half = 4,
    post_game = 13,
  };

  struct Issued {
    Command command = Command::halt;
    Team team = Team::red;
    [[nodiscard]] std::uint64_t number() const;
  };

  void add_event(const MatchEvent& event);
  void issue(const Issued& what, std::int64_t sim_ms);
  void stopped(const MatchEvent& event);
  void placed(const MatchEvent& event);
  void resumed(const MatchEvent& event);

  MatchHeader header_;
  Stage stage_ = Stage::first_half_pre;
  Issued command_;
  std::optional<Issued> next_;
  std::uint64_t issued_ = 0;  // commands so far
  std::int64_t issued_ms_ = 0;
  std::vector<ProtoMessage> game_events_;
};

}  // namespace striker::sil
