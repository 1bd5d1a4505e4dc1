// SPDX-License-Identifier: Apache-2.0
// What a client of the live view may send, at each of its three steps; the first byte says which: a request is let in with
// the token alone, frames are messages of bounded length or an error, and a message is a command within its ranges or none.
#include <boost/asio/io_context.hpp>
#include <boost/beast/_experimental/test/stream.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <string>
#include <string_view>

#include "sil/view/command.hpp"
#include "sil/view/web/access.hpp"
#include "tests/fuzz/support/bytes.hpp"

namespace {

namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using namespace striker;

const sil::AccessRules rules{
    .token = "0123456789abcdef0123456789abcdef", .address = "127.0.0.1", .port = 8080};

std::string_view plain(beast::string_view text) {
  return {text.data(), text.size()};
}

void try_command(std::string_view text) {
  const auto command = sil::parse_command(text);
  if (!command) {
    return;
  }
  fuzz::require(text.size() <= sil::most_command_bytes, "a command is short");
  fuzz::require(command->ticks >= 1 && command->ticks <= 1000, "steps are counted");
  fuzz::require(command->speed == 0.0 ||
                    (command->speed >= sil::least_view_speed && command->speed <= sil::greatest_view_speed),
                "a speed is within its range");
  fuzz::require(!command->robot || *command->robot < sil::most_viewed_robots, "a robot is one of ten");
  fuzz::require(command->for_ms <= 60'000, "a fault ends");
}

void try_request(std::string_view bytes) {
  http::request_parser<http::empty_body> parser;
  parser.header_limit(4096);
  parser.body_limit(0);
  parser.eager(true);
  beast::error_code error;
  parser.put(boost::asio::buffer(bytes.data(), bytes.size()), error);
  if (error || !parser.is_header_done()) {
    return;
  }
  const auto& request = parser.get();
  const sil::ViewRequest seen{.method = plain(request.method_string()),
                              .target = plain(request.target()),
                              .host = plain(request[http::field::host]),
                              .origin = plain(request[http::field::origin]),
                              .is_upgrade = websocket::is_upgrade(request)};
  const sil::Access access = sil::access_of(seen, rules);
  if (access != sil::Access::forbidden) {
    fuzz::require(seen.target.ends_with("?token=" + rules.token), "nobody is let in without the token");
    fuzz::require(seen.host.ends_with(":8080"), "nobody is let in by another name");
    fuzz::require(seen.origin.empty() ? !seen.is_upgrade : seen.origin == "http://" + std::string(seen.host),
                  "nobody is let in from another page");
  }
}

void try_frames(std::string_view bytes) {
  boost::asio::io_context context;
  websocket::stream<beast::test::stream> server(context);
  beast::test::stream client(context);
  server.next_layer().connect(client);
  websocket::request_type upgrade{http::verb::get, "/live", 11};
  upgrade.set(http::field::host, "127.0.0.1:8080");
  upgrade.set(http::field::connection, "Upgrade");
  upgrade.set(http::field::upgrade, "websocket");
  upgrade.set(http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ==");
  upgrade.set(http::field::sec_websocket_version, "13");
  beast::error_code error;
  server.read_message_max(sil::most_command_bytes);
  server.accept(upgrade, error);
  fuzz::require(!error, "the upgrade itself is right");
  server.next_layer().append({bytes.data(), bytes.size()});
  client.close();
  while (!error) {
    beast::flat_static_buffer<8192> buffer;
    server.read(buffer, error);
    fuzz::require(buffer.size() <= sil::most_command_bytes, "a message is short");
    if (!error && server.got_text()) {
      try_command({static_cast<const char*>(buffer.data().data()), buffer.size()});
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0]) {
    case 'c':
      try_command(rest);
      break;
    case 'r':
      try_request(rest);
      break;
    default:
      try_frames(rest);
      break;
  }
  return 0;
}
