// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/can/interface_watch.hpp"

#include <gtest/gtest.h>

#include <string>

namespace striker::host {
namespace {

using std::chrono::milliseconds;

// Comes back with the try of this number.
struct Socket {
  bool gone = false;
  int comes_back_at = 3;
  int tries = 0;

  [[nodiscard]] bool is_gone() const { return gone; }
  bool reopen() {
    gone = ++tries < comes_back_at;
    return !gone;
  }
};

std::string told_in(InterfaceWatch<Socket>& watch, int from_ms, int until_ms) {
  testing::internal::CaptureStderr();
  for (int at_ms = from_ms; at_ms < until_ms; at_ms += 20) {
    watch.look(BackOff::Time(std::chrono::hours(1) + milliseconds(at_ms)));
  }
  return testing::internal::GetCapturedStderr();
}

TEST(InterfaceWatch, LeavesASocketAloneThatIsThere) {
  Socket socket;
  InterfaceWatch watch(socket, "can7");
  EXPECT_EQ(told_in(watch, 0, 2'000), "");
  EXPECT_EQ(socket.tries, 0);
}

TEST(InterfaceWatch, TriesEverMoreSeldomUntilItIsBackAndTellsBothOnce) {
  Socket socket{.gone = true, .comes_back_at = 5};
  InterfaceWatch watch(socket, "can7");
  const std::string told = told_in(watch, 0, 1'400);
  EXPECT_EQ(socket.tries, 4);
  EXPECT_EQ(told.find("CAN interface 'can7' went away"), told.rfind("CAN interface"));
  EXPECT_NE(told_in(watch, 1'400, 3'000).find("'can7' is back: clear the fault, then arm"),
            std::string::npos);
  EXPECT_EQ(socket.tries, 5);
}

TEST(InterfaceWatch, TheNextTimeIsTriedAtOnceAgain) {
  Socket socket{.gone = true, .comes_back_at = 4};
  InterfaceWatch watch(socket, "can7");
  told_in(watch, 0, 1'000);
  socket = {.gone = true, .comes_back_at = 1};
  EXPECT_NE(told_in(watch, 1'000, 1'040).find("is back"), std::string::npos);
}

}  // namespace
}  // namespace striker::host
