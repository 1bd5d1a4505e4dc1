// SPDX-License-Identifier: Apache-2.0
// Whether a simulator has its bus to itself: with two of them, or with two controllers, every result is wrong, and
// nothing else would tell.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/can/codec.hpp"

namespace striker::sil {

class PeerWatch {
 public:
  // What this received frame gives away, or nothing.
  [[nodiscard]] std::optional<std::string_view> problem_of(const can::Frame& frame) {
    can::EndOfTick end;
    can::Heartbeat heartbeat;
    if (can::is<can::Sync>(frame)) {
      return "another simulator sends SYNC";
    }
    if (can::is<can::EndOfTick>(frame) && can::receive(frame, end) == can::Verdict::accepted) {
      return answered_twice(end.tick) ? std::optional<std::string_view>(two_controllers) : std::nullopt;
    }
    if (can::is<can::Heartbeat>(frame) && can::unpack(frame, heartbeat) == can::Verdict::accepted) {
      return alternates(heartbeat.uptime_ms) ? std::optional<std::string_view>(two_controllers)
                                             : std::nullopt;
    }
    return std::nullopt;
  }

 private:
  static constexpr std::string_view two_controllers = "two controllers answer";

  // SYNC(0) is repeated until it is answered: its answers may be several.
  bool answered_twice(std::int32_t tick) {
    const bool twice = tick != 0 && tick == last_ended_;
    last_ended_ = tick;
    return twice;
  }

  // A controller that was restarted goes back once; two of them go back again and again.
  bool alternates(std::int32_t uptime_ms) {
    constexpr int most_restarts = 3;
    constexpr int forgotten_after = 50;  // heartbeats
    const bool back = uptime_ms < last_uptime_ms_;
    last_uptime_ms_ = uptime_ms;
    back_ = back ? back_ + 1 : back_;
    since_back_ = back ? 0 : since_back_ + 1;
    back_ = since_back_ > forgotten_after ? 0 : back_;
    return back_ > most_restarts;
  }

  std::int32_t last_ended_ = -1;
  std::int32_t last_uptime_ms_ = 0;
  int back_ = 0;
  int since_back_ = 0;
};

}  // namespace striker::sil
