// SPDX-License-Identifier: Apache-2.0
// A player program of AI Soccer 2020 as a team, over its own TCP text protocol (wcg_ai_soccer_2020 c619e20), so that
// existing players connect unchanged: `player.py 127.0.0.1 PORT KEY DATAPATH`; any key is taken.
//
//   player                                             this
//   connects; aiwc.get_info("key")                 ─►
//                                                  ◄─  {sizes, limits}
//   aiwc.ready("key")                              ─►
//                                                  ◄─  {frame}                    each frame, 50 ms of the match
//   aiwc.set_speeds("key", 20 numbers)             ─►                             left, right, kick, jump of each robot
//                                                  ◄─  {frame, reset_reason 4}    when the match ends; then it hangs up
//
// Of set_speeds the wheels count; kick and jump need what these robots do not have. All other messages are skipped.
//
// In lockstep: each frame waits for the first set_speeds after it, at most the answer timeout of wall clock. A player
// that is late, silent, gone, or says nonsense costs its own team its orders of that frame (TeamOrders all none), and
// nobody else anything: text that is no message, or more than 500 messages in a frame, ends its connection, and what came
// late is not taken for an answer.
// A player that answers in time makes no difference to what is reproducible.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "sil/match/team/strategy.hpp"
#include "sil/match/team/tcp/player_messages.hpp"
#include "sil/match/team/tcp/player_socket.hpp"

namespace striker::sil {

struct TcpOptions {
  std::uint16_t port = 0;  // on 127.0.0.1; 0: any free one
  std::chrono::milliseconds answer_timeout{1'000};
  std::chrono::milliseconds ready_timeout{30'000};  // from the first frame on: as long as in AI Soccer
  int half_ms = 300'000;                            // for the player to know
  std::function<bool()> stop = {};                  // ends every wait early
};

class TcpStrategy final : public Strategy {
 public:
  // Listens from now on. Throws std::system_error if it cannot.
  explicit TcpStrategy(const TcpOptions& options);
  ~TcpStrategy() override;
  TcpStrategy(const TcpStrategy&) = delete;
  TcpStrategy& operator=(const TcpStrategy&) = delete;

  [[nodiscard]] TeamOrders play(const TeamView& view) override;

  [[nodiscard]] std::uint16_t port() const { return socket_.port(); }
  [[nodiscard]] bool is_connected() const { return socket_.is_connected(); }
  // Why the player is gone for good: "it never came"; none while it is there, or has not been waited for.
  [[nodiscard]] std::optional<std::string_view> why_gone() const;
  [[nodiscard]] int frames_without_answer() const { return frames_without_answer_; }

 private:
  using Deadline = PlayerSocket::Deadline;

  void wait_until_ready();
  void hang_up(std::string_view why);
  // The next message by then. Answers get_info by itself.
  [[nodiscard]] std::optional<PlayerMessage> next_message(Deadline deadline);
  [[nodiscard]] TeamOrders answer(Deadline deadline);

  TcpOptions options_;
  PlayerSocket socket_;
  PlayerMessages messages_;
  int messages_left_ = 0;  // of this frame's
  bool has_waited_ = false;
  std::string_view why_gone_ = "it hung up, or did not read what it was sent";
  TeamView last_view_;
  int frames_without_answer_ = 0;
};

// "tcp:5003" is port 5003; what does not begin with "tcp:" is none. Throws std::invalid_argument if no port from 1 to
// 65535 follows.
[[nodiscard]] std::optional<std::uint16_t> tcp_port_of(std::string_view team);

}  // namespace striker::sil
