// SPDX-License-Identifier: Apache-2.0
// Who is let in. The page and its socket are for whoever has the token, which is drawn anew for each run of the program and
// printed with the address. A browser says which page a request comes from (Origin, RFC 6454) and by which name it reached
// this machine (Host, RFC 9110 7.2): a page of somebody else's cannot use a token that it guessed, and a name that was made
// to point here (DNS rebinding) is not answered.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace striker::sil {

struct AccessRules {
  std::string token;    // 32 hexadecimal digits
  std::string address;  // that is listened on, as it stands in a URL: "127.0.0.1", "[::1]"
  std::uint16_t port = 0;
};

// Of a request; what it does not have is empty.
struct ViewRequest {
  std::string_view method;
  std::string_view target;
  std::string_view host;
  std::string_view origin;
  bool is_upgrade = false;  // to a WebSocket
};

enum class Access : std::uint8_t {
  page,        // GET /?token=...
  live,        // a WebSocket at /live?token=..., from a page of this server
  forbidden,   // another host or origin, or not the token
  not_found,   // the token, but no such place
  bad_method,  // not GET
};

[[nodiscard]] Access access_of(const ViewRequest& request, const AccessRules& rules);

// 128 bits from the system, as 32 hexadecimal digits.
[[nodiscard]] std::string draw_token();

}  // namespace striker::sil
