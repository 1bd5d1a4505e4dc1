// SPDX-License-Identifier: Apache-2.0
// One connection to the live view's server: a request, and if it is let in as one, a viewer's WebSocket. It lives as long as an
// operation of it is open. All in the server's thread.
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "sil/view/exchange.hpp"
#include "sil/view/web/access.hpp"

namespace striker::sil {

class Viewer;

// What all connections of a server have in common.
struct ViewHall {
  ViewExchange& exchange;
  AccessRules rules;
  std::string hello;
  std::set<Viewer*> viewers = {};
  std::size_t connections = 0;
  bool ended = false;

  static constexpr std::size_t most_connections = 64;
  static constexpr std::size_t most_viewers = 16;
};

using SharedText = std::shared_ptr<const std::string>;

class Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  // The hall outlives it.
  Viewer(boost::asio::ip::tcp::socket socket, ViewHall& hall);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  void begin();
  // Sent as soon as what is being sent is through, in place of what still waits.
  void show(const SharedText& text);
  // The last that is sent; then the connection is closed.
  void end(const SharedText& text);

 private:
  using Error = boost::beast::error_code;
  using Tcp = boost::beast::basic_stream<boost::asio::ip::tcp, boost::asio::any_io_executor,
                                         boost::beast::simple_rate_policy>;

  void answer();
  void send_response();
  void accept();
  void read();
  void obey();
  bool is_too_fast();
  void write_next();
  void close(boost::beast::websocket::close_code code);

  ViewHall* hall_;
  boost::beast::websocket::stream<Tcp> stream_;
  boost::beast::flat_static_buffer<8192> buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
  boost::beast::http::response<boost::beast::http::string_body> response_;
  SharedText sending_;
  SharedText waiting_;
  SharedText last_;
  bool closes_ = false;
  double allowance_;
  std::chrono::steady_clock::time_point last_message_;
};

}  // namespace striker::sil
