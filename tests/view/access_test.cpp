// SPDX-License-Identifier: Apache-2.0
// Who is let in to the live view, and who is not.
#include "sil/view/web/access.hpp"

#include <gtest/gtest.h>

#include <set>

namespace striker::sil {
namespace {

const AccessRules rules{.token = "0123456789abcdef0123456789abcdef", .address = "127.0.0.1", .port = 8080};
const std::string page = "/?token=" + rules.token;
const std::string live = "/live?token=" + rules.token;

Access page_from(std::string_view host, std::string_view origin = "", const AccessRules& by = rules) {
  return access_of({.method = "GET", .target = page, .host = host, .origin = origin}, by);
}

Access live_from(std::string_view host, std::string_view origin, std::string_view target = live) {
  return access_of({.method = "GET", .target = target, .host = host, .origin = origin, .is_upgrade = true},
                   rules);
}

TEST(ViewAccess, LetsInABrowserWithTheAddressThatWasPrinted) {
  EXPECT_EQ(page_from("127.0.0.1:8080"), Access::page);
  EXPECT_EQ(page_from("localhost:8080"), Access::page);
  EXPECT_EQ(live_from("127.0.0.1:8080", "http://127.0.0.1:8080"), Access::live);
  EXPECT_EQ(live_from("localhost:8080", "http://localhost:8080"), Access::live);
}

TEST(ViewAccess, KeepsOutWhoHasNotTheWholeToken) {
  for (const std::string& target :
       {std::string("/live"), std::string("/live?"), std::string("/live?token="),
        live.substr(0, live.size() - 1), live + "0", live + "&x=1", "/live?token=" + std::string(32, '0'),
        "/live?x=" + rules.token, "/live?Token=" + rules.token,
        std::string("/live?token=%30123456789abcdef0123456789abcdef"), std::string()}) {
    EXPECT_EQ(live_from("127.0.0.1:8080", "http://127.0.0.1:8080", target), Access::forbidden) << target;
  }
}

TEST(ViewAccess, KeepsOutATokenWithOneOtherDigitWhereverItIs) {
  for (std::size_t place = live.size() - rules.token.size(); place < live.size(); ++place) {
    std::string target = live;
    target[place] = target[place] == '0' ? '1' : '0';
    EXPECT_EQ(live_from("127.0.0.1:8080", "http://127.0.0.1:8080", target), Access::forbidden) << target;
  }
}

TEST(ViewAccess, KeepsOutOtherPagesAndSocketsOfNoPage) {
  for (const char* origin :
       {"", "null", "http://evil.example", "http://127.0.0.1:8081", "https://127.0.0.1:8080",
        "http://127.0.0.1:8080.evil.example", "http://localhost:8080", "http://127.0.0.1"}) {
    EXPECT_EQ(live_from("127.0.0.1:8080", origin), Access::forbidden) << origin;
  }
  EXPECT_EQ(page_from("127.0.0.1:8080", "http://evil.example"), Access::forbidden);
}

TEST(ViewAccess, KeepsOutNamesThatWereMadeToPointHere) {
  for (const char* host : {"", "evil.example:8080", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:8081", "several",
                           "127.0.0.1.evil.example:8080", "10.0.0.1:8080", ":8080"}) {
    EXPECT_EQ(page_from(host), Access::forbidden) << host;
    EXPECT_EQ(live_from(host, std::string("http://") + host), Access::forbidden) << host;
  }
}

TEST(ViewAccess, OnTheWebsOwnPortABrowserTellsNone) {
  AccessRules http = rules;
  http.port = 80;
  EXPECT_EQ(page_from("127.0.0.1", "", http), Access::page);
  EXPECT_EQ(page_from("[::1]", "", http), Access::page);
  EXPECT_EQ(page_from("127.0.0.1:80", "", http), Access::page);
  EXPECT_EQ(page_from("127.0.0.1", "http://127.0.0.1", http), Access::page);
  for (const char* host : {"", "evil.example", "127.0.0.1:8080", "127.0.0.1:", "127.0.0.1:8080]", "[::1"}) {
    EXPECT_EQ(page_from(host, "", http), Access::forbidden) << host;
  }
}

TEST(ViewAccess, OnAllAddressesTakesAddressesAndNoNames) {
  AccessRules all = rules;
  all.address = "0.0.0.0";
  EXPECT_EQ(page_from("10.0.0.1:8080", "", all), Access::page);
  EXPECT_EQ(page_from("[fe80::1]:8080", "", all), Access::page);
  EXPECT_EQ(page_from("evil.example:8080", "", all), Access::forbidden);
  EXPECT_EQ(page_from("cafe:8080", "", all), Access::forbidden);
}

TEST(ViewAccess, KnowsOnePageAndOneSocketAndReadsThemOnly) {
  const auto asked = [](std::string_view method, const std::string& target, bool is_upgrade) {
    return access_of({.method = method,
                      .target = target,
                      .host = "127.0.0.1:8080",
                      .origin = "http://127.0.0.1:8080",
                      .is_upgrade = is_upgrade},
                     rules);
  };
  EXPECT_EQ(asked("POST", page, false), Access::bad_method);
  EXPECT_EQ(asked("GET", "/other?token=" + rules.token, false), Access::not_found);
  EXPECT_EQ(asked("GET", "/../etc/passwd?token=" + rules.token, false), Access::not_found);
  EXPECT_EQ(asked("GET", live, false), Access::not_found);
  EXPECT_EQ(asked("GET", page, true), Access::not_found);
}

TEST(ViewAccess, DrawsAnotherTokenEachTime) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) {
    const std::string token = draw_token();
    EXPECT_EQ(token.size(), 32U);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
    tokens.insert(token);
  }
  EXPECT_EQ(tokens.size(), 100U);
}

}  // namespace
}  // namespace striker::sil
