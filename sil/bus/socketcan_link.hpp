// SPDX-License-Identifier: Apache-2.0
// The controller behind SocketCAN, in lockstep or on its own clock.
//
// Lockstep: SYNC(0) is repeated until it is answered. A tick without an answer within the answer timeout is
// told on stderr; from then on the simulator runs on unanswered, a tick a millisecond of wall clock. When the
// controller is heard again, the simulator waits until the bus is silent, so that no late answer can be taken
// for a new one, and is back in lockstep. A full queue gets the answer timeout to take a frame: without it the tick
// could not be repeated.
//
// On its own clock nothing waits: a frame that the queue does not take is lost, as on any bus. An interface that goes
// is looked for, for 10 s, and the world goes on meanwhile.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "firmware/host/can/back_off.hpp"
#include "firmware/host/can/can_socket.hpp"
#include "sil/bus/controller_link.hpp"
#include "sil/bus/peer_watch.hpp"

namespace striker::sil {

struct SocketCanOptions {
  std::chrono::milliseconds answer_timeout{1000};
  std::chrono::milliseconds start_timeout{10000};
};

// One interface as the simulator sees it. Receiving throws std::runtime_error when the bus turns out to be shared
// with another simulator, or with two controllers.
class BusEnd {
 public:
  explicit BusEnd(const std::string& interface);
  // Frames that a full queue does not take are lost.
  void send(std::span<const can::Frame> frames);
  // Throws std::runtime_error if a queue stays full for longer than the patience.
  void send_all(std::span<const can::Frame> frames, std::chrono::milliseconds patience);
  std::optional<can::Frame> receive();
  // Throws as the constructor does.
  void reopen();
  bool wait(std::chrono::microseconds timeout) { return socket_.wait(timeout); }

 private:
  std::string interface_;
  host::CanSocket socket_;
  PeerWatch watch_;
};

class LockstepLink final : public ControllerLink {
 public:
  LockstepLink(const std::string& interface, const SocketCanOptions& options);
  void send(std::uint32_t tick, std::span<const can::Frame> frames) override;
  // Throws std::runtime_error if tick 0 stays unanswered for the start timeout, the interface goes away, or its queue
  // stays full.
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override;

 private:
  bool await_answer(std::uint32_t tick, std::chrono::microseconds timeout, std::vector<can::Frame>& answer);
  void await_start(std::vector<can::Frame>& answer);
  void listen_for_return(std::uint32_t tick);

  BusEnd bus_;
  SocketCanOptions options_;
  std::vector<can::Frame> first_;  // of tick 0, to be sent again
  bool answered_ = true;
};

class FreeRunningLink final : public ControllerLink {
 public:
  explicit FreeRunningLink(const std::string& interface);
  // Throws host::InterfaceGone when the interface was away for 10 s.
  void send(std::uint32_t tick, std::span<const can::Frame> frames) override;
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override;

 private:
  using Clock = std::chrono::steady_clock;

  // False as long as the interface is away.
  bool is_there();
  void lose(const host::InterfaceGone& why);

  BusEnd bus_;
  std::string interface_;
  std::optional<host::InterfaceGone> gone_;
  Clock::time_point gone_since_;
  host::BackOff back_off_;
};

}  // namespace striker::sil
