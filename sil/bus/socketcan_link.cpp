// SPDX-License-Identifier: Apache-2.0
#include "sil/bus/socketcan_link.hpp"

#include <fmt/core.h>

#include <stdexcept>

#include "firmware/host/stop_signal.hpp"
#include "sil/bus/controller_messages.hpp"
#include "sil/bus/end_of_tick.hpp"

namespace striker::sil {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration_cast;
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr milliseconds start_retry{200};
constexpr milliseconds unanswered_tick{1};
constexpr milliseconds silence{20};

// A full queue in lockstep means a peer that does not read: the frame is lost as on a real bus.
void send_all(host::CanSocket& socket, std::span<const can::Frame> frames) {
  for (const can::Frame& frame : frames) {
    socket.send(frame);
  }
}

}  // namespace

LockstepLink::LockstepLink(const std::string& interface, const SocketCanOptions& options)
    : socket_(interface, controller_identifiers), options_(options) {}

void LockstepLink::send(std::uint32_t tick, std::span<const can::Frame> frames) {
  if (tick == 0) {
    first_.assign(frames.begin(), frames.end());
  }
  send_all(socket_, frames);
}

void LockstepLink::collect(std::uint32_t tick, std::vector<can::Frame>& answer) {
  if (tick == 0) {
    return await_start(answer);
  }
  if (!answered_) {
    return listen_for_return(tick);
  }
  if (!await_answer(tick, options_.answer_timeout, answer) && !host::stop_requested()) {
    answered_ = false;
    fmt::print(stderr,
               "striker-sil: no answer from the controller at tick {} within {} ms: running on unanswered\n",
               tick, options_.answer_timeout.count());
  }
}

bool LockstepLink::await_answer(std::uint32_t tick, microseconds timeout, std::vector<can::Frame>& answer) {
  const std::size_t begin = answer.size();
  const auto deadline = Clock::now() + timeout;
  while (true) {
    while (const auto frame = socket_.receive()) {
      answer.push_back(*frame);
      const AnswerEnd end = end_of_answer(*frame, tick);
      if (end == AnswerEnd::of_this_tick) {
        return true;
      }
      if (end == AnswerEnd::of_another_tick) {
        answer.resize(begin);
      }
    }
    const auto rest = duration_cast<microseconds>(deadline - Clock::now());
    if (rest <= microseconds(0) || host::stop_requested()) {
      answer.resize(begin);
      return false;
    }
    socket_.wait(rest);
  }
}

void LockstepLink::await_start(std::vector<can::Frame>& answer) {
  const auto deadline = Clock::now() + options_.start_timeout;
  while (!await_answer(0, start_retry, answer) && !host::stop_requested()) {
    if (Clock::now() >= deadline) {
      throw std::runtime_error(
          fmt::format("no controller answered SYNC within {} s: start it with 'striker-firmware --can IFACE "
                      "--clock sync' on the same interface, or use --bus inproc",
                      duration_cast<std::chrono::seconds>(options_.start_timeout).count()));
    }
    send_all(socket_, first_);
  }
}

void LockstepLink::listen_for_return(std::uint32_t tick) {
  if (!socket_.wait(unanswered_tick)) {
    return;
  }
  while (socket_.wait(silence)) {
    while (socket_.receive()) {
    }
  }
  answered_ = true;
  fmt::print(stderr, "striker-sil: the controller answers again, from tick {}\n", tick + 1);
}

FreeRunningLink::FreeRunningLink(const std::string& interface) : socket_(interface, controller_identifiers) {}

void FreeRunningLink::send(std::uint32_t, std::span<const can::Frame> frames) {
  send_all(socket_, frames);
}

void FreeRunningLink::collect(std::uint32_t, std::vector<can::Frame>& answer) {
  while (const auto frame = socket_.receive()) {
    answer.push_back(*frame);
  }
}

}  // namespace striker::sil
