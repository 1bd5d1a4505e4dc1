// SPDX-License-Identifier: Apache-2.0
#include "sil/bus/socketcan_link.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
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
constexpr std::chrono::seconds away_limit{10};

constexpr auto simulator_receives = [] {
  std::array<std::uint16_t, controller_identifiers.size() + 1> identifiers{};
  *std::copy(controller_identifiers.begin(), controller_identifiers.end(), identifiers.begin()) =
      can::layout<can::Sync>.info.id;
  return identifiers;
}();

}  // namespace

BusEnd::BusEnd(const std::string& interface)
    : interface_(interface), socket_(interface, simulator_receives) {}

void BusEnd::send(std::span<const can::Frame> frames) {
  for (const can::Frame& frame : frames) {
    socket_.send(frame);
  }
}

void BusEnd::send_all(std::span<const can::Frame> frames, milliseconds patience) {
  for (const can::Frame& frame : frames) {
    if (!socket_.send(frame, patience) && !host::stop_requested()) {
      throw std::runtime_error(socket_.full_queue(patience));
    }
  }
}

void BusEnd::reopen() {
  const host::CanSocket anew(interface_, simulator_receives);
  socket_.adopt(anew);
}

std::optional<can::Frame> BusEnd::receive() {
  const auto frame = socket_.receive();
  if (frame) {
    if (const auto problem = watch_.problem_of(*frame)) {
      throw std::runtime_error(fmt::format(
          "can:{}: {} on this bus: stop it, or use an interface of its own for each", interface_, *problem));
    }
  }
  return frame;
}

LockstepLink::LockstepLink(const std::string& interface, const SocketCanOptions& options)
    : bus_(interface), options_(options) {}

void LockstepLink::send(std::uint32_t tick, std::span<const can::Frame> frames) {
  if (tick == 0) {
    first_.assign(frames.begin(), frames.end());
  }
  bus_.send_all(frames, options_.answer_timeout);
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
    while (const auto frame = bus_.receive()) {
      answer.push_back(*frame);
      answer.back().age_ms = 0;  // in lockstep a frame is as old as logical time says
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
    bus_.wait(rest);
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
    bus_.send_all(first_, options_.answer_timeout);
  }
}

void LockstepLink::listen_for_return(std::uint32_t tick) {
  if (!bus_.wait(unanswered_tick)) {
    return;
  }
  while (bus_.wait(silence)) {
    while (bus_.receive()) {
    }
  }
  answered_ = true;
  fmt::print(stderr, "striker-sil: the controller answers again, from tick {}\n", tick + 1);
}

FreeRunningLink::FreeRunningLink(const std::string& interface) : bus_(interface), interface_(interface) {}

void FreeRunningLink::send(std::uint32_t, std::span<const can::Frame> frames) {
  if (gone_ && !is_there()) {
    return;
  }
  try {
    bus_.send(frames);
  } catch (const host::InterfaceGone& why) {
    lose(why);
  }
}

void FreeRunningLink::lose(const host::InterfaceGone& why) {
  fmt::print(stderr, "striker-sil: {}: looked for, for {} s\n", why.what(), away_limit.count());
  gone_ = why;
  gone_since_ = Clock::now();
  back_off_.reset();
}

bool FreeRunningLink::is_there() {
  const auto now = Clock::now();
  if (now - gone_since_ > away_limit) {
    throw host::InterfaceGone(*gone_);
  }
  if (!back_off_.due(now)) {
    return false;
  }
  try {
    bus_.reopen();
  } catch (const std::runtime_error&) {
    return false;
  }
  gone_.reset();
  fmt::print(stderr, "striker-sil: CAN interface '{}' is back\n", interface_);
  return true;
}

void FreeRunningLink::collect(std::uint32_t, std::vector<can::Frame>& answer) {
  while (const auto frame = bus_.receive()) {
    answer.push_back(*frame);
  }
}

}  // namespace striker::sil
