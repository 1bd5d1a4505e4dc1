// SPDX-License-Identifier: Apache-2.0
// A player program in a thread of the test: it connects, and does what the test tells it to.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <thread>

namespace striker::sil {

class TestPlayer {
 public:
  TestPlayer(std::uint16_t port, std::function<void(TestPlayer&)> plays)
      : thread_([this, port, plays = std::move(plays)] {
          connect_to(port);
          plays(*this);
          hang_up();
        }) {}
  ~TestPlayer() { thread_.join(); }
  TestPlayer(const TestPlayer&) = delete;
  TestPlayer& operator=(const TestPlayer&) = delete;

  // Whether the other end took it.
  bool say(std::string_view text) {
    while (!text.empty()) {
      const ssize_t sent = send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
      if (sent <= 0) {
        return false;
      }
      text.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  // The next JSON text, whose braces are all its own; nothing if the other end hung up, or is silent for 10 s.
  std::string hear() {
    while (true) {
      int depth = 0;
      for (std::size_t i = 0; i < heard_.size(); ++i) {
        depth += heard_[i] == '{' ? 1 : (heard_[i] == '}' ? -1 : 0);
        if (depth == 0) {
          std::string text = heard_.substr(0, i + 1);
          heard_.erase(0, i + 1);
          return text;
        }
      }
      char part[4096];
      pollfd polled = {.fd = socket_, .events = POLLIN, .revents = 0};
      const ssize_t size = poll(&polled, 1, 10'000) > 0 ? recv(socket_, part, sizeof part, 0) : 0;
      if (size <= 0) {
        return {};
      }
      heard_.append(part, static_cast<std::size_t>(size));
    }
  }
  void get_ready() {
    say("aiwc.get_info(\"k\")");
    (void)hear();
    say("aiwc.ready(\"k\")");
  }
  void hang_up() {
    if (socket_ >= 0) {
      close(socket_);
      socket_ = -1;
    }
  }

 private:
  void connect_to(std::uint16_t port) {
    socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    (void)connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }

  int socket_ = -1;
  std::string heard_;
  std::thread thread_;  // last: it uses the others
};

// All wheels, kicks and jumps at this number.
inline std::string speeds(double number, int count = 20) {
  std::string text = "aiwc.set_speeds(\"k\"";
  for (int i = 0; i < count; ++i) {
    text += ", " + std::to_string(number);
  }
  return text + ")";
}

}  // namespace striker::sil
