// SPDX-License-Identifier: Apache-2.0
// Serves the live page and its sockets, in one thread of its own: HTTP and WebSocket by Boost.Beast. It shares nothing with
// the run but the exchange, so that no client can make the run wait; what it spends is its own.
//
// What a client may cost, whatever it does:
//   connections    64 at a time, 16 of them viewers; further ones are closed at once
//   a request      4 KB of header, no body, within 5 s of connecting; one a connection
//   a message      256 bytes of text that is a command (command.hpp), 40 at once and 20 a second; anything else, or more,
//                  closes the connection; of pings and the like no more is read than 16 KB a second
//   a queue        the state that is being sent and the latest: what a slow one was too slow for is dropped
//   a dead one     closed after 20 s without a sign of life
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "sil/view/exchange.hpp"
#include "sil/view/state_json.hpp"

namespace striker::sil {

struct ViewServerPlan {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  // 0: any that is free
  ViewFacts facts;
};

class ViewServer {
 public:
  // Listens when it returns. The exchange outlives it. Throws std::runtime_error with one line, as where the port is taken.
  ViewServer(const ViewServerPlan& plan, ViewExchange& exchange);
  // Without `finish` viewers are told that the run failed.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  // For a browser, with the token.
  [[nodiscard]] const std::string& url() const;

  // Shows the last state, tells why the run ended, and ends the thread: within a second, whatever clients do.
  void finish(const std::string& why);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace striker::sil
