// SPDX-License-Identifier: Apache-2.0
// The one connection of a player program, on 127.0.0.1. Nothing here waits beyond a deadline, and nothing that a player
// does is an exception: it hangs up, and is gone for good.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string_view>

namespace striker::sil {

class PlayerSocket {
 public:
  using Deadline = std::chrono::steady_clock::time_point;

  // Listens from now on. Port 0: any free one. `stop` ends every wait early, within 100 ms. Throws std::system_error if
  // it cannot listen.
  explicit PlayerSocket(std::uint16_t port, std::function<bool()> stop = {});
  ~PlayerSocket();
  PlayerSocket(const PlayerSocket&) = delete;
  PlayerSocket& operator=(const PlayerSocket&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] bool is_connected() const { return player_ >= 0; }

  // Whether a player has connected by then. The first one is the only one.
  bool accept(Deadline deadline);
  // All of it, or the player is gone.
  void send(std::string_view text, Deadline deadline);
  // What has come by then; nothing, if nothing has or the player is gone. Valid until the next call.
  [[nodiscard]] std::string_view receive(Deadline deadline);
  void hang_up();

 private:
  void stop_listening();
  // Whether there is something to read, room to write or a hang-up by then; at least one look.
  [[nodiscard]] bool is_ready(int file, short events, Deadline deadline) const;

  std::function<bool()> stop_;
  int listener_ = -1;
  int player_ = -1;
  std::uint16_t port_ = 0;
  char received_[4096] = {};
};

}  // namespace striker::sil
