// SPDX-License-Identifier: Apache-2.0
#include "sil/view/web/access.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>

namespace striker::sil {

namespace {

// Takes as long wherever the first difference is.
bool is_token(std::string_view given, std::string_view token) {
  unsigned difference = given.size() == token.size() ? 0 : 1;
  for (std::size_t i = 0; i < token.size(); ++i) {
    const char other = i < given.size() ? given[i] : '\0';
    difference |= static_cast<unsigned char>(other) ^ static_cast<unsigned char>(token[i]);
  }
  return difference == 0;
}

bool listens_to_all(std::string_view address) {
  return address == "0.0.0.0" || address == "[::]";
}

// An address and no name: digits and dots, or in brackets. Nobody can make one of those point elsewhere.
bool is_literal(std::string_view name) {
  const auto all_of = [&](std::string_view allowed) {
    return !name.empty() && name.find_first_not_of(allowed) == std::string_view::npos;
  };
  return all_of("0123456789.") ||
         (name.starts_with('[') && name.ends_with(']') && all_of("[]:.0123456789abcdefABCDEF"));
}

// Without HTTP's own port, which browsers leave out. Nothing if it is another.
std::optional<std::string_view> name_in(std::string_view host, std::uint16_t port) {
  constexpr std::uint16_t http_port = 80;
  const std::string told = fmt::format(":{}", port);
  if (host.ends_with(told)) {
    return host.substr(0, host.size() - told.size());
  }
  const bool tells_none = host.find(':') == std::string_view::npos || host.ends_with(']');
  return port == http_port && tells_none ? std::optional(host) : std::nullopt;
}

bool is_here(std::string_view host, const AccessRules& rules) {
  const auto name = name_in(host, rules.port);
  if (!name) {
    return false;
  }
  constexpr std::array<std::string_view, 3> own = {"127.0.0.1", "localhost", "[::1]"};
  return *name == rules.address || std::ranges::find(own, *name) != own.end() ||
         (listens_to_all(rules.address) && is_literal(*name));
}

bool comes_from_here(std::string_view origin, std::string_view host) {
  constexpr std::string_view scheme = "http://";
  return origin.starts_with(scheme) && origin.substr(scheme.size()) == host;
}

}  // namespace

Access access_of(const ViewRequest& request, const AccessRules& rules) {
  constexpr std::string_view key = "?token=";
  const std::size_t query = request.target.find('?');
  const std::string_view path = request.target.substr(0, query);
  const std::string_view asked = query == std::string_view::npos ? "" : request.target.substr(query);
  const bool has_token = asked.starts_with(key) && is_token(asked.substr(key.size()), rules.token);
  // A page that is opened has no origin; a WebSocket from a browser always has one.
  const bool origin_is_right =
      (request.origin.empty() && !request.is_upgrade) || comes_from_here(request.origin, request.host);
  if (!has_token || !is_here(request.host, rules) || !origin_is_right) {
    return Access::forbidden;
  }
  if (request.method != "GET") {
    return Access::bad_method;
  }
  if (path == "/" && !request.is_upgrade) {
    return Access::page;
  }
  return path == "/live" && request.is_upgrade ? Access::live : Access::not_found;
}

std::string draw_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) {
    token += fmt::format("{:08x}", device());
  }
  return token;
}

}  // namespace striker::sil
