// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/tcp/player_frames.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/match/team/views.hpp"

namespace striker::sil {
namespace {

using Json = nlohmann::json;

// A player that reads 4,096 bytes at once must get it as a whole.
constexpr std::size_t one_read = 4096;

TEST(PlayerInfo, NamesTheWorldsSizes) {
  const std::string text = player_info(300'000);
  EXPECT_LT(text.size(), one_read);
  const Json info = Json::parse(text);
  EXPECT_EQ(info["field"], Json({7.8, 4.65}));
  EXPECT_NEAR(info["goal"][0].get<double>(), 0.45, 1e-12);
  EXPECT_EQ(info["goal"][1], 1.0);
  EXPECT_NEAR(info["penalty_area"][0].get<double>(), 0.9, 1e-12);
  EXPECT_NEAR(info["goal_area"][0].get<double>(), 0.4, 1e-12);
  EXPECT_EQ(info["ball_radius"], 0.05);
  EXPECT_EQ(info["max_linear_velocity"], Json({1.8, 2.1, 2.1, 2.55, 2.55}));
  EXPECT_EQ(info["max_torque"], Json({0.8, 1.2, 1.2, 0.4, 0.4}));
  EXPECT_EQ(info["robot_body_mass"], Json({2.5, 2.0, 2.0, 1.5, 1.5}));
  EXPECT_EQ(info["game_time"], 600.0);
  EXPECT_EQ(info["number_of_robots"], 5);
  EXPECT_EQ(info["keyboard"], false);
}

TEST(PlayerFrame, ShowsWhatAPlayerSees) {
  TeamView view = home_view();
  view.clock_ms = 12'350;
  view.half = 2;
  view.score = {3, 1};
  view.state = GameState::corner;
  view.has_ball = true;
  view.own[2] = {{-1.0, 0.1, -3.0}, false, true};
  view.ball_m = {0.1, -0.2};
  view.ball_height_m = 0.25;
  const std::string text = player_frame(view, {3, 1});
  EXPECT_LT(text.size(), one_read);
  const Json frame = Json::parse(text);
  EXPECT_EQ(frame["time"], 12.35);
  EXPECT_EQ(frame["score"], Json({3, 1}));
  EXPECT_EQ(frame["reset_reason"], 0);
  EXPECT_EQ(frame["game_state"], 3);
  EXPECT_EQ(frame["ball_ownership"], true);
  EXPECT_EQ(frame["half_passed"], true);
  EXPECT_EQ(frame["coordinates"][0][2], Json({-1.0, 0.1, 0.0, -3.0, false, true, false}));
  EXPECT_EQ(frame["coordinates"][1].size(), 5U);
  EXPECT_EQ(frame["coordinates"][1][0][0], 3.8);
  EXPECT_EQ(frame["coordinates"][2], Json({0.1, -0.2, 0.25, nullptr, nullptr, nullptr}));
  EXPECT_EQ(frame["EOF"], true);
}

TEST(PlayerFrame, NumbersStatesAndReasonsAsAiSoccerDoes) {
  TeamView view = home_view();
  const auto field = [&](const char* key) { return Json::parse(player_frame(view, {0, 0}))[key].get<int>(); };
  const std::pair<GameState, int> states[] = {{GameState::open_play, 0}, {GameState::kickoff, 1},
                                              {GameState::goal_kick, 2}, {GameState::corner, 3},
                                              {GameState::penalty, 4},   {GameState::pause, 0}};
  for (const auto& [state, number] : states) {
    view.state = state;
    EXPECT_EQ(field("game_state"), number);
  }
  const std::pair<ResetReason, int> reasons[] = {
      {ResetReason::game_start, 1}, {ResetReason::game_end, 4},    {ResetReason::deadlock, 5},
      {ResetReason::goal_kick, 6},  {ResetReason::corner_kick, 7}, {ResetReason::penalty_kick, 8},
      {ResetReason::half_time, 9}};
  for (const auto& [reason, number] : reasons) {
    view.reset_reason = reason;
    EXPECT_EQ(field("reset_reason"), number);
  }
}

// A team does not know its colour; the score says who it was.
TEST(PlayerFrame, TellsWhetherTheOwnTeamScored) {
  for (const ResetReason reason : {ResetReason::red_scored, ResetReason::blue_scored}) {
    TeamView view = home_view();
    view.reset_reason = reason;
    view.score = {1, 0};
    EXPECT_EQ(Json::parse(player_frame(view, {0, 0}))["reset_reason"], 2);
    view.score = {0, 1};
    EXPECT_EQ(Json::parse(player_frame(view, {0, 0}))["reset_reason"], 3);
  }
}

// Doubles come out as they went in.
TEST(PlayerFrame, KeepsEveryBit) {
  RandomViews views(5);
  for (int round = 0; round < 1'000; ++round) {
    const TeamView& view = views.next();
    const Json frame = Json::parse(player_frame(view, {0, 0}));
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      ASSERT_EQ(frame["coordinates"][0][id][0].get<double>(), view.own[id].pose.x_m);
      ASSERT_EQ(frame["coordinates"][0][id][3].get<double>(), view.own[id].pose.heading_rad);
    }
    ASSERT_EQ(frame["coordinates"][2][1].get<double>(), view.ball_m.y);
  }
}

}  // namespace
}  // namespace striker::sil
