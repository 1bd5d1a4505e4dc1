// SPDX-License-Identifier: Apache-2.0
#include "sil/view/web/viewer.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "sil/view/web/page.hpp"

namespace striker::sil {

namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;

namespace {

constexpr std::chrono::seconds request_time{5};
constexpr std::chrono::seconds dead_after{20};
constexpr std::uint32_t most_header_bytes = 4096;
constexpr int most_kernel_bytes = 128 * 1024;  // that lie in its queue for a slow client
// So that what is no message, as a ping, costs no more than messages may: 40 of the longest commands.
constexpr std::size_t most_read_bytes_a_s = 16'384;
constexpr double most_commands_at_once = 40.0;
constexpr double commands_per_s = 20.0;

std::string_view plain(beast::string_view text) {
  return {text.data(), text.size()};
}

// Nothing from elsewhere, in nobody's frame, and the address with its token is told nobody.
void set_headers(http::response<http::string_body>& response) {
  response.set(http::field::content_type, "text/html; charset=utf-8");
  response.set(http::field::cache_control, "no-store");
  response.set("Referrer-Policy", "no-referrer");
  response.set("X-Content-Type-Options", "nosniff");
  response.set(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; connect-src 'self'; "
      "base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  response.keep_alive(false);
  response.prepare_payload();
}

}  // namespace

Viewer::Viewer(boost::asio::ip::tcp::socket socket, ViewHall& hall)
    : hall_(&hall), stream_(std::move(socket)), allowance_(most_commands_at_once) {
  ++hall_->connections;
}

Viewer::~Viewer() {
  hall_->viewers.erase(this);
  --hall_->connections;
}

void Viewer::begin() {
  Error ignored;
  auto& socket = beast::get_lowest_layer(stream_).socket();
  beast::get_lowest_layer(stream_).rate_policy().read_limit(most_read_bytes_a_s);
  socket.set_option(boost::asio::ip::tcp::no_delay(true), ignored);
  socket.set_option(boost::asio::socket_base::send_buffer_size(most_kernel_bytes), ignored);
  parser_.emplace();
  parser_->header_limit(most_header_bytes);
  parser_->body_limit(0);
  beast::get_lowest_layer(stream_).expires_after(request_time);
  http::async_read(stream_.next_layer(), buffer_, *parser_,
                   [self = shared_from_this()](Error error, std::size_t) {
                     if (!error) {
                       self->answer();
                     }
                   });
}

void Viewer::answer() {
  const auto& request = parser_->get();
  const auto field = [&](http::field name) {
    return request.count(name) > 1 ? std::string_view("several") : plain(request[name]);
  };
  const Access access = access_of({.method = plain(request.method_string()),
                                   .target = plain(request.target()),
                                   .host = field(http::field::host),
                                   .origin = field(http::field::origin),
                                   .is_upgrade = websocket::is_upgrade(request)},
                                  hall_->rules);
  response_ = {http::status::forbidden, 11};
  switch (access) {
    case Access::live:
      if (hall_->viewers.size() < ViewHall::most_viewers && !hall_->ended) {
        accept();
        return;
      }
      response_.result(http::status::service_unavailable);
      break;
    case Access::page:
      response_.result(http::status::ok);
      response_.body() = std::string(view_page());
      break;
    case Access::not_found:
      response_.result(http::status::not_found);
      break;
    case Access::bad_method:
      response_.result(http::status::method_not_allowed);
      break;
    case Access::forbidden:
      break;
  }
  send_response();
}

void Viewer::send_response() {
  set_headers(response_);
  http::async_write(stream_.next_layer(), response_, [self = shared_from_this()](Error error, std::size_t) {
    if (!error) {
      self->stream_.next_layer().socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, error);
    }
  });
}

void Viewer::accept() {
  beast::get_lowest_layer(stream_).expires_never();
  stream_.set_option(websocket::stream_base::timeout{request_time, dead_after, true});
  stream_.read_message_max(most_command_bytes);
  stream_.auto_fragment(false);
  hall_->viewers.insert(this);
  sending_ = std::make_shared<const std::string>(hall_->hello);  // what is shown meanwhile waits
  stream_.async_accept(parser_->get(), [self = shared_from_this()](Error error) {
    if (error) {
      self->hall_->viewers.erase(self.get());
      return;
    }
    self->buffer_.clear();
    self->last_message_ = std::chrono::steady_clock::now();
    self->write_next();
    self->read();
  });
}

void Viewer::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t) {
    if (error) {
      self->hall_->viewers.erase(self.get());
      return;
    }
    self->obey();
  });
}

// Whoever sends what is no command is not read any further.
void Viewer::obey() {
  const auto data = buffer_.data();
  const auto command = parse_command({static_cast<const char*>(data.data()), data.size()});
  if (!stream_.got_text() || !command || is_too_fast() || !hall_->exchange.commands.put(*command)) {
    close(websocket::close_code::policy_error);
    return;
  }
  buffer_.clear();
  read();
}

bool Viewer::is_too_fast() {
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> passed = now - std::exchange(last_message_, now);
  allowance_ = std::min(most_commands_at_once, allowance_ + commands_per_s * passed.count()) - 1.0;
  return allowance_ < 0.0;
}

void Viewer::show(const SharedText& text) {
  waiting_ = text;
  if (!sending_) {
    sending_ = std::exchange(waiting_, nullptr);
    write_next();
  }
}

void Viewer::end(const SharedText& text) {
  last_ = text;
  if (!sending_) {
    sending_ = std::exchange(last_, nullptr);
    closes_ = true;
    write_next();
  }
}

void Viewer::write_next() {
  stream_.text(true);
  stream_.async_write(boost::asio::buffer(*sending_), [self = shared_from_this()](Error error, std::size_t) {
    if (error) {
      self->hall_->viewers.erase(self.get());
      return;
    }
    self->sending_ = std::exchange(self->waiting_, nullptr);
    if (!self->sending_ && self->last_) {
      self->sending_ = std::exchange(self->last_, nullptr);
      self->closes_ = true;
    }
    if (self->sending_) {
      self->write_next();
    } else if (self->closes_) {
      self->close(websocket::close_code::normal);
    }
  });
}

void Viewer::close(websocket::close_code code) {
  hall_->viewers.erase(this);
  stream_.async_close(code, [self = shared_from_this()](Error) {});
}

}  // namespace striker::sil
