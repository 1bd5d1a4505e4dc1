// SPDX-License-Identifier: Apache-2.0
// match.log.gz: a match as an SSL game log (game_log.hpp), for the tools of RoboCup's Small Size League. Each frame has a
// vision record, once a second with the field's geometry, and a tracker record; a referee record follows each ruling with
// an event, and once a second. Messages are those of sil/match/record/proto (ssl_vision.hpp, ssl_referee.hpp).
//
// Every time in it is simulated time from 0, as if the match began with 1970: same match, same bytes. To see one record:
// protoc --decode=striker.ssl.Referee ssl_referee.proto < payload
#pragma once

#include <filesystem>

#include "sil/match/record/match_frame.hpp"
#include "sil/match/record/ssl/game_log.hpp"
#include "sil/match/record/ssl/ssl_referee.hpp"

namespace striker::sil {

// Written to a temporary file, renamed at the end. Throws std::runtime_error that names the file.
class SslLog final : public MatchObserver {
 public:
  explicit SslLog(const std::filesystem::path& file) : log_(file) {}

  void begin(const MatchHeader& header) override { referee_.begin(header); }
  void frame(const MatchFrame& frame) override;
  void end(const MatchEnd& /*end*/) override { log_.finish(); }

 private:
  GameLog log_;
  SslReferee referee_;
};

}  // namespace striker::sil
