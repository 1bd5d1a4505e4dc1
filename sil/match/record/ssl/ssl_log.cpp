// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/ssl/ssl_log.hpp"

#include "sil/match/record/ssl/ssl_vision.hpp"

namespace striker::sil {

void SslLog::frame(const MatchFrame& frame) {
  constexpr std::int64_t frames_a_second = 1'000 / frame_ms;
  const std::int64_t time_ns = frame.ruling.sim_ms * 1'000'000;
  const bool is_full_second = frame.number % frames_a_second == 0;
  log_.write(time_ns, SslRecord::vision, vision_packet(frame, is_full_second));
  log_.write(time_ns, SslRecord::tracker, tracker_packet(frame));
  referee_.add(frame.ruling);
  if (is_full_second || !frame.ruling.events.empty()) {
    log_.write(time_ns, SslRecord::referee, referee_.packet(frame.ruling));
  }
}

}  // namespace striker::sil
