// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/tcp/tcp_strategy.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "sil/match/team/tcp/player_frames.hpp"

namespace striker::sil {

namespace {

constexpr std::size_t numbers_a_robot = 4;  // left, right, kick, jump
constexpr int most_messages = 500;          // a frame: or who talks without end would hold up the match

// All or nothing: one number that is none, and the whole answer is nonsense.
TeamOrders orders_of(const PlayerMessage& speeds) {
  TeamOrders orders;
  if (speeds.numbers.size() != numbers_a_robot * robots_a_team) {
    return {};
  }
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    const double left_m_s = speeds.numbers[numbers_a_robot * id];
    const double right_m_s = speeds.numbers[numbers_a_robot * id + 1];
    if (!std::isfinite(left_m_s) || !std::isfinite(right_m_s)) {
      return {};
    }
    orders[id] = SpeedOrder{left_m_s, right_m_s};
  }
  return orders;
}

PlayerSocket::Deadline after(std::chrono::milliseconds time) {
  return std::chrono::steady_clock::now() + time;
}

}  // namespace

TcpStrategy::TcpStrategy(const TcpOptions& options)
    : options_(options), socket_(options.port, options.stop) {}

TcpStrategy::~TcpStrategy() {
  if (has_waited_ && is_connected()) {
    const auto score = last_view_.score;
    last_view_.reset_reason = ResetReason::game_end;
    socket_.send(player_frame(last_view_, score), after(options_.answer_timeout));
  }
}

TeamOrders TcpStrategy::play(const TeamView& view) {
  messages_left_ = most_messages;
  if (!has_waited_) {
    has_waited_ = true;
    last_view_ = view;
    wait_until_ready();
  }
  while (next_message(after({}))) {  // too late
  }
  const Deadline deadline = after(options_.answer_timeout);
  socket_.send(player_frame(view, last_view_.score), deadline);
  last_view_ = view;
  const TeamOrders orders = answer(deadline);
  frames_without_answer_ += orders == TeamOrders{} ? 1 : 0;
  return orders;
}

void TcpStrategy::wait_until_ready() {
  const Deadline deadline = after(options_.ready_timeout);
  if (!socket_.accept(deadline)) {
    why_gone_ = "it never came";
    return;
  }
  while (const auto message = next_message(deadline)) {
    if (message->name == "ready") {
      return;
    }
  }
  hang_up("it did not get ready in time");
}

void TcpStrategy::hang_up(std::string_view why) {
  if (is_connected()) {
    why_gone_ = why;
    socket_.hang_up();
  }
}

std::optional<std::string_view> TcpStrategy::why_gone() const {
  return has_waited_ && !is_connected() ? std::optional(why_gone_) : std::nullopt;
}

std::optional<PlayerMessage> TcpStrategy::next_message(Deadline deadline) {
  while (true) {
    auto message = messages_.next();
    if (messages_.is_broken()) {
      hang_up("it said what is no message");
      return std::nullopt;
    }
    if (!message) {
      const std::string_view text = socket_.receive(deadline);
      if (text.empty()) {
        return std::nullopt;
      }
      messages_.add(text);
      continue;
    }
    if (--messages_left_ <= 0) {
      hang_up("it said too much in one frame");
      return std::nullopt;
    }
    if (message->name == "get_info") {
      socket_.send(player_info(options_.half_ms), after(options_.answer_timeout));
    } else {
      return message;
    }
  }
}

TeamOrders TcpStrategy::answer(Deadline deadline) {
  while (const auto message = next_message(deadline)) {
    if (message->name == "set_speeds") {
      return orders_of(*message);
    }
  }
  return {};
}

std::optional<std::uint16_t> tcp_port_of(std::string_view team) {
  constexpr std::string_view prefix = "tcp:";
  if (!team.starts_with(prefix)) {
    return std::nullopt;
  }
  const auto number = team.substr(prefix.size());
  std::uint16_t port = 0;
  const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), port);
  if (error != std::errc{} || stop != number.data() + number.size() || port == 0) {
    throw std::invalid_argument(fmt::format("\"{}\" names no port: tcp:1 to tcp:65535", team));
  }
  return port;
}

}  // namespace striker::sil
