#include "sil/bus/socketcan_link.hpp"

#include <fmt/core.h>

#include <array>
#include <stdexcept>

#include "firmware/can/codec.hpp"
#include "firmware/host/stop_signal.hpp"

namespace striker::sil {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration_cast;
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr milliseconds start_retry{200};
constexpr milliseconds unanswered_tick{1};
constexpr milliseconds silence{20};

constexpr std::array<std::uint16_t, 7> controller_sends = {
    can::layout<can::FaultReport>.info.id, can::layout<can::WheelCommand>.info.id,
    can::layout<can::Status>.info.id,      can::layout<can::Decision>.info.id,
    can::layout<can::Timing>.info.id,      can::layout<can::Heartbeat>.info.id,
    can::layout<can::Version>.info.id};

// A full queue in lockstep means a peer that does not read: the frame is lost as on a real bus.
void send_all(host::CanSocket& socket, std::span<const can::Frame> frames) {
  for (const can::Frame& frame : frames) {
    socket.send(frame);
  }
}

bool answers(const can::Frame& frame, std::uint32_t tick) {
  can::WheelCommand command;
  return can::unpack(frame, command) == can::Verdict::accepted &&
         static_cast<std::uint32_t>(command.tick_low) == (tick & 0xFU);
}

}  // namespace

LockstepLink::LockstepLink(const std::string& interface, const SocketCanOptions& options)
    : socket_(interface, controller_sends), options_(options) {}

bool LockstepLink::await_answer(std::uint32_t tick, microseconds timeout, std::vector<can::Frame>& answer) {
  const std::size_t begin = answer.size();
  const auto deadline = Clock::now() + timeout;
  while (true) {
    while (const auto frame = socket_.receive()) {
      answer.push_back(*frame);
      if (can::is<can::WheelCommand>(*frame)) {
        if (answers(*frame, tick)) {
          return true;
        }
        answer.resize(begin);  // the end of a late answer to an earlier tick
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

void LockstepLink::start(std::span<const can::Frame> sent, std::vector<can::Frame>& answer) {
  const auto deadline = Clock::now() + options_.start_timeout;
  do {
    send_all(socket_, sent);
    if (await_answer(0, start_retry, answer) || host::stop_requested()) {
      return;
    }
  } while (Clock::now() < deadline);
  throw std::runtime_error(
      fmt::format("no controller answered SYNC within {} s: start it with 'striker-firmware "
                  "--can IFACE --clock sync' on the same interface, or use --bus inproc",
                  duration_cast<std::chrono::seconds>(options_.start_timeout).count()));
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

void LockstepLink::exchange(std::uint32_t tick, std::span<const can::Frame> sent,
                            std::vector<can::Frame>& answer) {
  if (tick == 0) {
    return start(sent, answer);
  }
  send_all(socket_, sent);
  if (!answered_) {
    ++unanswered_;
    return listen_for_return(tick);
  }
  if (!await_answer(tick, options_.answer_timeout, answer) && !host::stop_requested()) {
    ++unanswered_;
    answered_ = false;
    fmt::print(stderr,
               "striker-sil: no answer from the controller at tick {} within {} ms: running on unanswered\n",
               tick, options_.answer_timeout.count());
  }
}

FreeRunningLink::FreeRunningLink(const std::string& interface) : socket_(interface, controller_sends) {}

void FreeRunningLink::exchange(std::uint32_t, std::span<const can::Frame> sent,
                               std::vector<can::Frame>& answer) {
  send_all(socket_, sent);
  while (const auto frame = socket_.receive()) {
    answer.push_back(*frame);
  }
}

}  // namespace striker::sil
