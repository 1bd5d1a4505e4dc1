// SPDX-License-Identifier: Apache-2.0
#include "sil/task/kick_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace striker::sil {
namespace {

KickOutcome kick() {
  return {.contact = true,
          .contact_decision = 12,
          .theta_contact_rad = 0.1,
          .v_contact_m_s = 2.5,
          .front_face = true,
          .reward = 11.6,
          .ball_measured = true,
          .ball_speed_m_s = 4.0,
          .ball_angle_rad = -0.05,
          .kicked = true};
}

KickOutcome miss() {
  return {.reward = -4.0};
}

KickRun some_run() {
  return {.seed = 7,
          .plant = "servo",
          .pose = "origin",
          .policy = "0123abcd",
          .simulated_s = 4.2,
          .wall_s = 0.1,
          .episodes = {kick(), miss()}};
}

std::filesystem::path scratch(const char* name) {
  std::filesystem::path directory =
      std::filesystem::path(testing::TempDir()) / ("striker_report_" + std::string(name));
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory);
  return directory;
}

TEST(KickReport, SummaryOfKnownRewards) {
  const KickSummary summary = kick_summary({kick(), miss(), miss(), kick()});
  EXPECT_NEAR(summary.mean_reward, 3.8, 1e-12);
  EXPECT_NEAR(summary.contact_rate, 0.5, 1e-12);
  EXPECT_NEAR(summary.kick_rate, 0.5, 1e-12);
  // Deviations of 7.8 from the mean: s = 7.8 sqrt(4 / 3).
  EXPECT_NEAR(summary.reward_ci95, 1.96 * 7.8 * std::sqrt(4.0 / 3.0) / 2.0, 1e-12);
}

TEST(KickReport, SummaryOfOneAndOfNone) {
  EXPECT_EQ(kick_summary({kick()}).reward_ci95, 0.0);
  EXPECT_EQ(kick_summary({}).mean_reward, 0.0);
}

TEST(KickReport, JsonHoldsEverything) {
  const std::filesystem::path file = scratch("json") / "run.json";
  write_json(some_run(), file);
  std::ifstream in(file);
  const nlohmann::json json = nlohmann::json::parse(in);
  EXPECT_EQ(json.at("episodes"), 2);
  EXPECT_EQ(json.at("seed"), 7);
  EXPECT_EQ(json.at("plant"), "servo");
  EXPECT_EQ(json.at("pose"), "origin");
  EXPECT_EQ(json.at("policy"), "0123abcd");
  EXPECT_NEAR(json.at("mean_reward").get<double>(), 3.8, 1e-12);
  EXPECT_EQ(json.at("contact_rate"), 0.5);
  EXPECT_EQ(json.at("kick_rate"), 0.5);
  EXPECT_GT(json.at("reward_ci95").get<double>(), 0.0);
  EXPECT_NEAR(json.at("realtime_factor").get<double>(), 42.0, 1e-9);
  const nlohmann::json& row = json.at("rows").at(0);
  EXPECT_EQ(row.at("episode"), 0);
  EXPECT_EQ(row.at("contact"), true);
  EXPECT_EQ(row.at("contact_decision"), 12);
  EXPECT_EQ(row.at("theta_contact_rad"), 0.1);
  EXPECT_EQ(row.at("v_contact_m_s"), 2.5);
  EXPECT_EQ(row.at("reward"), 11.6);
  EXPECT_EQ(row.at("ball_speed_m_s"), 4.0);
  EXPECT_EQ(row.at("ball_angle_rad"), -0.05);
  EXPECT_EQ(row.at("kicked"), true);
  const nlohmann::json& missed = json.at("rows").at(1);
  EXPECT_EQ(missed.at("contact"), false);
  EXPECT_EQ(missed.at("reward"), -4.0);
  for (const char* field :
       {"contact_decision", "theta_contact_rad", "v_contact_m_s", "ball_speed_m_s", "ball_angle_rad"}) {
    EXPECT_TRUE(missed.at(field).is_null()) << field;
  }
}

TEST(KickReport, NothingIsLeftBesideTheFile) {
  const std::filesystem::path directory = scratch("alone");
  write_json(some_run(), directory / "run.json");
  write_json(some_run(), directory / "run.json");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory), {}), 1);
}

TEST(KickReport, AnImpossibleFileIsNamed) {
  const std::filesystem::path directory = scratch("impossible");
  for (const std::filesystem::path& file : {directory / "none" / "run.json", directory}) {
    try {
      write_json(some_run(), file);
      ADD_FAILURE() << file << " was written";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory));
}

TEST(KickReport, TheTableIsAlignedAndHasARowAnEpisode) {
  std::istringstream table(format_table(some_run(), true));
  std::string header;
  std::string hit;
  std::string missed;
  std::string means;
  std::getline(table, header);
  std::getline(table, hit);
  std::getline(table, missed);
  std::getline(table, means);
  EXPECT_NE(header.find("m_s"), std::string::npos);
  EXPECT_EQ(hit.size(), header.size());
  EXPECT_EQ(missed.size(), header.size());
  EXPECT_EQ(hit.find(" - "), std::string::npos);
  EXPECT_NE(missed.find(" - "), std::string::npos);
  EXPECT_NE(means.find("3.800"), std::string::npos);
  EXPECT_EQ(format_table(some_run(), false), means + "\n");
}

}  // namespace
}  // namespace striker::sil
