// SPDX-License-Identifier: Apache-2.0
// What the page is told is JSON, with what was on the bus in it, whatever the state.
#include "sil/view/state_json.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "firmware/can/codec.hpp"

namespace striker::sil {
namespace {

TEST(StateJson, OfARunThatHasNotBegunIsWhole) {
  const auto json = nlohmann::json::parse(state_text({.robot_count = 10}));
  EXPECT_EQ(json["state"]["robots"].size(), 10U);
  EXPECT_TRUE(json["state"]["robots"][0]["decision"].is_null());
}

TEST(StateJson, TellsDecisionsAndWheelsInUnits) {
  LiveState state{.robot_count = 1};
  can::SendCounter counter;
  const can::Frame command =
      can::send(can::WheelCommand{.left_torque_mNm = -200, .right_set_point_2mm_s = 300}, counter);
  const can::Frame measured = can::send(can::WheelState{.left_mm_s = -40, .right_mm_s = 580}, counter);
  state.robots[0].wheels[0] = {.tick = 5, .command = command, .state = measured};
  state.robots[0].wheel_samples = 1;
  const auto json = nlohmann::json::parse(state_text(state));
  EXPECT_EQ(json["state"]["robots"][0]["wheels"].dump(), "[[5,0,600,-40,580,-200,0]]");
}

TEST(StateJson, OfFramesWithWrongBytesTellsNothing) {
  LiveState state{.robot_count = 1};
  for (SeenMessage& message : state.robots[0].messages) {
    message = {.count = 1,
               .last = {.id = 0x7FF, .length = 8, .data = {255, 255, 255, 255, 255, 255, 255, 255}}};
  }
  const auto robot = nlohmann::json::parse(state_text(state))["state"]["robots"][0];
  EXPECT_TRUE(robot["decision"].is_null());
  EXPECT_FALSE(robot.contains("state"));
}

TEST(StateJson, KnowsTheMessageTableAndWhichFramesAreLockstepsOwn) {
  const auto hello =
      nlohmann::json::parse(hello_text({.scenario = "kick", .teams = {}, .faults = {"loss"}}))["hello"];
  EXPECT_EQ(hello["messages"].size(), message_kinds + 1);
  for (const auto& message : hello["messages"]) {
    EXPECT_EQ(message["lockstep"], message["name"] == "Sync" || message["name"] == "EndOfTick");
  }
}

TEST(StateJson, AnEndAndATeamAreTextWhateverTheirBytes) {
  EXPECT_TRUE(nlohmann::json::parse(ended_text("\xff\"</script>")).contains("ended"));
  const auto hello =
      nlohmann::json::parse(hello_text({.scenario = "match", .teams = {"\xff"}, .faults = {}}));
  EXPECT_EQ(hello["hello"]["teams"].size(), 1U);
}

TEST(StateJson, ASeedKeepsAllItsBits) {
  const auto json = nlohmann::json::parse(state_text({.seed = UINT64_MAX}));
  EXPECT_EQ(json["state"]["seed"], "18446744073709551615");
}

}  // namespace
}  // namespace striker::sil
