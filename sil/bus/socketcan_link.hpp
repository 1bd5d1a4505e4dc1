// SPDX-License-Identifier: Apache-2.0
// The controller behind SocketCAN, in lockstep or on its own clock.
//
// Lockstep: SYNC(0) is repeated until it is answered. A tick without an answer within the answer timeout is
// told on stderr; from then on the simulator runs on unanswered, a tick a millisecond of wall clock. When the
// controller is heard again, the simulator waits until the bus is silent, so that no late answer can be taken
// for a new one, and is back in lockstep.
#pragma once

#include <chrono>
#include <optional>
#include <string>

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
  void send(std::span<const can::Frame> frames);
  std::optional<can::Frame> receive();
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
  // Throws std::runtime_error if tick 0 stays unanswered for the start timeout, or the interface goes away.
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
  void send(std::uint32_t tick, std::span<const can::Frame> frames) override;
  void collect(std::uint32_t tick, std::vector<can::Frame>& answer) override;

 private:
  BusEnd bus_;
};

}  // namespace striker::sil
