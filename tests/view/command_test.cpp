// SPDX-License-Identifier: Apache-2.0
// What is a viewer's command, and what is not.
#include "sil/view/command.hpp"

#include <gtest/gtest.h>

#include <string>

namespace striker::sil {
namespace {

ViewCommand parsed(std::string_view text) {
  const auto command = parse_command(text);
  EXPECT_TRUE(command) << text;
  return command.value_or(ViewCommand{});
}

TEST(ViewCommand, IsReadWithAllThatItSays) {
  EXPECT_EQ(parsed(R"({"do": "pause"})").action, ViewAction::pause);
  EXPECT_EQ(parsed(R"({"do": "run"})").action, ViewAction::run);
  EXPECT_EQ(parsed(R"({"do": "step"})").ticks, 1U);
  EXPECT_EQ(parsed(R"({"do": "step", "ticks": 50})").ticks, 50U);
  EXPECT_EQ(parsed(R"({"do": "speed", "x": 0.1})").speed, 0.1);
  EXPECT_EQ(parsed(R"({"do": "speed", "x": 20})").speed, 20.0);
  EXPECT_EQ(parsed(R"({"do": "speed", "x": "max"})").speed, 0.0);
  EXPECT_EQ(parsed(R"({"do": "restart", "seed": 18446744073709551615})").seed, UINT64_MAX);
  EXPECT_FALSE(parsed(R"({"do": "stop"})").robot);
  EXPECT_EQ(parsed(R"({"do": "stop", "robot": 9})").robot, 9U);
  const ViewCommand fault = parsed(R"({"do": "fault", "robot": 3, "kind": "bus_off", "ms": 500})");
  EXPECT_EQ(fault.robot, 3U);
  EXPECT_EQ(fault.kind, FaultKind::bus_off);
  EXPECT_EQ(fault.for_ms, 500U);
}

TEST(ViewCommand, IsNothingElse) {
  for (const char* text : {
           "",
           "{",
           "null",
           "[]",
           "\"pause\"",
           "{}",
           R"({"do": 1})",
           R"({"do": "Pause"})",
           R"({"do": "shell"})",
           R"({"do": "pause", "robot": 1})",
           R"({"do": "pause"} x)",
           R"({"do": "step", "ticks": 0})",
           R"({"do": "step", "ticks": 1001})",
           R"({"do": "step", "ticks": -1})",
           R"({"do": "step", "ticks": 1.5})",
           R"({"do": "step", "ticks": "1"})",
           R"({"do": "speed"})",
           R"({"do": "speed", "x": 0})",
           R"({"do": "speed", "x": 0.09})",
           R"({"do": "speed", "x": 1e300})",
           R"({"do": "speed", "x": -1})",
           R"({"do": "speed", "x": "fast"})",
           R"({"do": "speed", "x": null})",
           R"({"do": "restart"})",
           R"({"do": "restart", "seed": -1})",
           R"({"do": "restart", "seed": 1.0})",
           R"({"do": "restart", "seed": 18446744073709551616})",
           R"({"do": "stop", "robot": 10})",
           R"({"do": "stop", "robot": null})",
           R"({"do": "fault", "robot": 0, "kind": "loss"})",
           R"({"do": "fault", "robot": 0, "kind": "no_such", "ms": 5})",
           R"({"do": "fault", "robot": 0, "kind": "loss", "ms": 0})",
           R"({"do": "fault", "robot": 0, "kind": "loss", "ms": 60001})",
           R"({"do": "fault", "kind": "loss", "ms": 5})",
       }) {
    EXPECT_FALSE(parse_command(text)) << text;
  }
}

TEST(ViewCommand, IsShort) {
  const std::string short_enough = R"({"do":"pause"})" + std::string(most_command_bytes - 14, ' ');
  EXPECT_TRUE(parse_command(short_enough));
  EXPECT_FALSE(parse_command(short_enough + " "));
  EXPECT_FALSE(parse_command(std::string(most_command_bytes, '[')));
}

}  // namespace
}  // namespace striker::sil
