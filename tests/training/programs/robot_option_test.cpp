// SPDX-License-Identifier: Apache-2.0
// A robot of one's own, from its description through every program to the exported header.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tests/training/programs/command_line.hpp"

namespace striker::training {
namespace {

class RobotOption : public CommandLine {
 protected:
  // 2.5 kg and 1.6 m/s.
  std::string a_robot() {
    write_to(path("mine.toml"),
             "body_mass_g = 2_500\nwheel_mass_g = 120\nwheel_radius_um = 50_000\naxle_length_um = 160_000\n"
             "torque_limit_mNm = 600\ntop_rim_speed_mm_s = 1_600\n");
    return path("mine.toml");
  }

  // A training of a second that leaves the actions to the robot.
  [[nodiscard]] std::string train(const std::string& out, const std::string& options) {
    write_to(path("short.toml"),
             "[run]\nepisodes = 30\nvalidation_episodes = 20\n[learner]\nwarm_up = 200\n");
    return fmt::format("{} --config {} --seed 3 --out {} {}", STRIKER_TRAIN, path("short.toml"), path(out),
                       options);
  }

  static std::string forward_file() { return STRIKER_SOURCES "/firmware/robots/forward.toml"; }
};

TEST_F(RobotOption, TheForwardsChangesNoByte) {
  ASSERT_EQ(run(train("a", "")).code, 0);
  ASSERT_EQ(run(train("b", "--robot " + forward_file())).code, 0);
  EXPECT_EQ(content_of(path("a/model.safetensors")), content_of(path("b/model.safetensors")));
}

TEST_F(RobotOption, AModelIsForTheRobotThatItWasTrainedFor) {
  const Result trained = run(train("mine", "--robot " + a_robot()));
  ASSERT_EQ(trained.code, 0) << trained.err;
  const std::string model = path("mine/model.safetensors");
  const std::string play =
      fmt::format("{} --model {} --episodes 60 --seed 4 --json ", STRIKER_EVALUATE, model);
  const auto reward = [&](const std::string& options) {
    const Result result = run(play + path("r.json") + options);
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(content_of(path("r.json"))).at("mean_reward").get<double>();
  };
  const double of_its_own = reward("");
  EXPECT_EQ(reward(" --robot " + a_robot()), of_its_own);
  EXPECT_NE(reward(" --robot " + forward_file()), of_its_own);
  const Result exported = run(fmt::format("{} {} -o {}", STRIKER_EXPORT, model, path("mine.hpp")));
  ASSERT_EQ(exported.code, 0) << exported.err;
  EXPECT_NE(content_of(path("mine.hpp")).find(".left_mm_s = 1600, .right_mm_s = 1600"), std::string::npos);
}

TEST_F(RobotOption, ATrainingDoesNotGoOnWithAnotherRobot) {
  const std::string robot = "--robot " + a_robot();
  ASSERT_EQ(run(train("mine", robot)).code, 0);
  EXPECT_EQ(run(train("mine", "--resume --set run.episodes=31 " + robot)).code, 0);
  expect_refusal(train("mine", "--resume --set robot.body_mass_g=2600 " + robot),
                 "robot.body_mass_g was 2500 and is 2600");
  expect_refusal(train("mine", "--resume"), "robot.axle_length_um was 160000 and is its default");
}

TEST_F(RobotOption, WhatItCannotDriveIsRefused) {
  expect_refusal(train("a", "--set 'task.actions=[[2.0, 2.0], [0.0, 0.0]]' --robot " + a_robot()),
                 "from -1.6 to 1.6");
  expect_refusal(
      fmt::format("{} --model {} --episodes 5 --seed 1 --robot {}", STRIKER_EVALUATE, a_model(), a_robot()),
      "task.actions[0] = [2.55, 2.55]: a wheel of the robot reaches 1.6 m/s");
}

TEST_F(RobotOption, WhatIsNoRobotIsRefusedByEveryProgram) {
  write_to(path("wrong.toml"), "body_mass_g = 5\n");
  const std::string robot = "--robot " + path("wrong.toml");
  const std::string complaint =
      path("wrong.toml") + ": line 1: body_mass_g = 5 must be a whole number from 200 to 100000";
  expect_refusal(train("a", robot), complaint);
  expect_refusal(fmt::format("{} --model {} --episodes 5 --seed 1 {}", STRIKER_EVALUATE, a_model(), robot),
                 complaint);
  expect_refusal(fmt::format("{} --episodes 5 --seed 1 {}", STRIKER_CEILING, robot), complaint);
  expect_refusal(train("a", "--set robot.body_mass_g=5"),
                 "robot.body_mass_g = 5: must be a whole number from 200");
  EXPECT_FALSE(std::filesystem::exists(path("a")));
}

TEST_F(RobotOption, TheCeilingIsTheRobots) {
  const std::string command = fmt::format("{} --episodes 40 --seed 5 --rivals --json ", STRIKER_CEILING);
  const auto report = [&](const std::string& options) {
    const Result result = run(command + path("c.json") + options);
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(content_of(path("c.json")));
  };
  const auto forward = report("");
  const auto mine = report(" --robot " + a_robot());
  EXPECT_EQ(report(" --robot " + forward_file()), forward);
  EXPECT_EQ(forward.at("robot").at("body_mass_g"), 1500);
  EXPECT_EQ(mine.at("robot").at("body_mass_g"), 2500);
  EXPECT_LT(mine.at("mean_reward"), forward.at("mean_reward"));
  EXPECT_GE(mine.at("mean_reward"), mine.at("rivals").at("planner").at("mean_reward"));
}

}  // namespace
}  // namespace striker::training
