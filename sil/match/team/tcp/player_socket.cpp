// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/tcp/player_socket.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace striker::sil {

namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

bool may_come_again(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

PlayerSocket::PlayerSocket(std::uint16_t port, std::function<bool()> stop) : stop_(std::move(stop)) {
  listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (listener_ < 0) {
    fail("a socket for a player");
  }
  const int yes = 1;
  setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const any_address = reinterpret_cast<sockaddr*>(&address);
  if (bind(listener_, any_address, size) != 0 || listen(listener_, 1) != 0 ||
      getsockname(listener_, any_address, &size) != 0) {
    const int error = errno;
    stop_listening();
    errno = error;
    fail("listening for a player on 127.0.0.1");
  }
  port_ = ntohs(address.sin_port);
}

PlayerSocket::~PlayerSocket() {
  hang_up();
  stop_listening();
}

bool PlayerSocket::is_ready(int file, short events, Deadline deadline) const {
  constexpr std::int64_t longest_ms = 100;  // between two looks at `stop`
  while (true) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd polled = {.fd = file, .events = events, .revents = 0};
    const int ready =
        poll(&polled, 1, static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, longest_ms)));
    if (ready > 0) {
      return true;
    }
    if ((ready < 0 && errno != EINTR) || std::chrono::steady_clock::now() >= deadline || (stop_ && stop_())) {
      return false;
    }
  }
}

bool PlayerSocket::accept(Deadline deadline) {
  while (listener_ >= 0 && is_ready(listener_, POLLIN, deadline)) {
    player_ = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (player_ >= 0) {
      const int yes = 1;
      setsockopt(player_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
      stop_listening();
    } else if (may_come_again(errno) || errno == ECONNABORTED) {
      continue;
    }
    break;
  }
  return is_connected();
}

void PlayerSocket::send(std::string_view text, Deadline deadline) {
  while (is_connected() && !text.empty()) {
    const ssize_t sent = ::send(player_, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent > 0) {
      text.remove_prefix(static_cast<std::size_t>(sent));
    } else if (!may_come_again(errno) || !is_ready(player_, POLLOUT, deadline)) {
      hang_up();
    }
  }
}

std::string_view PlayerSocket::receive(Deadline deadline) {
  while (is_connected() && is_ready(player_, POLLIN, deadline)) {
    const ssize_t size = recv(player_, received_, sizeof received_, 0);
    if (size > 0) {
      return {received_, static_cast<std::size_t>(size)};
    }
    if (size == 0 || !may_come_again(errno)) {
      hang_up();
    }
  }
  return {};
}

void PlayerSocket::hang_up() {
  if (player_ >= 0) {
    close(player_);
    player_ = -1;
  }
}

void PlayerSocket::stop_listening() {
  if (listener_ >= 0) {
    close(listener_);
    listener_ = -1;
  }
}

}  // namespace striker::sil
