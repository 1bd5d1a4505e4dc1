// SPDX-License-Identifier: Apache-2.0
// The configuration: what is wrong is named.
#include "training/run/config.hpp"

#include "firmware/core/robot_ranges.hpp"
#include "firmware/policy/exported/aimed.hpp"
#include "firmware/policy/exported/kick.hpp"
#include "firmware/policy/exported/kick_dqn.hpp"
#include "tests/training/fixtures.hpp"
#include "training/model/hash.hpp"
#include "training/run/config_changes.hpp"

namespace striker::training {
namespace {

struct Wrong {
  const char* name;
  const char* from;  // a line of paper.toml
  const char* to;
  std::vector<const char*> complaints;
};

const std::vector<Wrong> wrong = {
    {"UnknownKey", "gamma = 0.95", "gamma = 0.95\ngama = 0.9", {"learner.gama", "learner.gamma"}},
    {"UnknownTable", "[optimiser]", "[extra]\nkey = 1\n[optimiser]", {"extra.key"}},
    {"UnknownTopKey", "[run]", "key = 1\n[run]", {"key is not a key"}},
    {"NoTable", "[ball]", "[nothing]", {"nothing.aim_radius_m is not a key"}},
    {"TextForNumber", "batch = 64", "batch = \"64\"", {"learner.batch = '64'", "2 to 4096"}},
    {"FractionForWhole", "batch = 64", "batch = 64.5", {"learner.batch = 64.5", "whole number"}},
    {"NumberForTruth", "huber = false", "huber = 0", {"learner.huber = 0", "true or false"}},
    {"TextForChoice",
     "velocities = \"true\"",
     "velocities = \"real\"",
     {"task.velocities", "real", "\"both\""}},
    {"TruthForChoice", "velocities = \"true\"", "velocities = true", {"task.velocities = true", "\"true\""}},
    {"TooLarge", "gamma = 0.95", "gamma = 1.5", {"learner.gamma = 1.5", "0 to 1"}},
    {"TooSmall", "batch = 64", "batch = 1", {"learner.batch = 1", "2 to 4096"}},
    {"BeyondInt", "batch = 64", "batch = 4294967360", {"learner.batch = 4294967360"}},
    {"NotANumber", "learning_rate = 2e-3", "learning_rate = nan", {"optimiser.learning_rate = nan"}},
    {"UnknownElement",
     "inputs = \"rcs\"",
     "inputs = [\"ball_z\"]",
     {"task.inputs", "\"ball_z\" is no element"}},
    {"TooLongAgo", "inputs = \"rcs\"", "inputs = [\"ball_x@9\"]", {"task.inputs", "ball_x@9", "1 to 4"}},
    {"NoInputs", "inputs = \"rcs\"", "inputs = []", {"task.inputs"}},
    {"OneAction",
     "actions = [[2.55, 2.55], [0.0, 0.0], [-2.55, -2.55]]",
     "actions = [[0.0, 0.0]]",
     {"task.actions", "2 to 16"}},
    {"NoPair", "[0.0, 0.0], ", "[0.0], ", {"task.actions", "2 numbers"}},
    {"TooFast", "[0.0, 0.0], ", "[0.0, 3.0], ", {"task.actions", "2.55"}},
    {"RobotTooHeavy", "mass_g = 1500", "mass_g = 100001", {"robot.body_mass_g = 100001", "200 to 100000"}},
    {"HalfAGramme", "mass_g = 1500", "mass_g = 1500.5", {"robot.body_mass_g = 1500.5", "whole number"}},
    {"RobotsUnknownKey", "mass_g = 1500", "weight_g = 1500", {"robot.body_weight_g", "robot.body_mass_g"}},
    {"TooFastForThatRobot", "speed_mm_s = 2550", "speed_mm_s = 1800", {"task.actions", "-1.8 to 1.8"}},
    {"NoWheelLoops",
     "body_mass_g = 1500\nwheel_mass_g = 100\nwheel_radius_um = 40_000",
     "body_mass_g = 100000\nwheel_mass_g = 100\nwheel_radius_um = 200_000",
     {"robot.torque_limit_mNm = 400", "32 bits"}},
    {"UnknownKind", "kind = \"kick\"", "kind = \"dribble\"", {"task.kind = 'dribble'", "must be \"kick\""}},
    {"SpeedsTurned", "speed_m_s = [1.0, 3.0]", "speed_m_s = [3.0, 1.0]", {"ball.speed_m_s", "lower"}},
    {"HalfANeuron", "hidden = [64, 64]", "hidden = [64, 0.5]", {"network.hidden"}},
    {"NoHiddenLayer", "hidden = [64, 64]", "hidden = []", {"network.hidden", "1 to 3 numbers"}},
    {"FourHiddenLayers", "hidden = [64, 64]", "hidden = [8, 8, 8, 8]", {"network.hidden", "1 to 3 numbers"}},
    {"EmptyHiddenLayer", "hidden = [64, 64]", "hidden = [64, 0, 64]", {"network.hidden", "1 to 1024"}},
    {"NoToml", "[optimiser]", "[optimiser", {"line "}},
};

class WrongConfig : public testing::TestWithParam<Wrong> {};

TEST_P(WrongConfig, IsRefusedByName) {
  const std::string text = replaced(paper_text(), GetParam().from, GetParam().to);
  expect_refused([&] { (void)parse_config(text, "some.toml"); }, "some.toml", GetParam().complaints);
}

TEST(Config, OneToThreeHiddenLayersAreRead) {
  for (const auto& [text, hidden] : std::map<std::string, std::vector<int>>{
           {"[7]", {7}}, {"[64, 1]", {64, 1}}, {"[1024, 1, 12]", {1024, 1, 12}}}) {
    const Config config = parse_config(replaced(paper_text(), "hidden = [64, 64]", "hidden = " + text), "f");
    EXPECT_EQ(config.shape.hidden, hidden);
  }
}

INSTANTIATE_TEST_SUITE_P(Config, WrongConfig, testing::ValuesIn(wrong),
                         [](const auto& tested) { return tested.param.name; });

TEST(Config, TheCommittedOnesAreRead) {
  const std::filesystem::path configs = STRIKER_CONFIGS;
  const Config paper = load_config(configs / "paper.toml");
  EXPECT_EQ(paper.name, "paper");
  EXPECT_EQ(paper.run.episodes, 5000);
  EXPECT_EQ(paper.environments.front().inputs, rcs_inputs());
  EXPECT_EQ(paper.shape, Shape{});
  EXPECT_EQ(paper.learner.n_step, 1);
  EXPECT_FALSE(paper.learner.double_dqn);
  EXPECT_EQ(paper.environments.size(), 1U);
  EXPECT_EQ(load_config(configs / "kick.toml").name, "kick");
}

// What a file leaves out is paper.toml's, and the text that is kept names every key.
TEST(Config, EmptyIsThePapers) {
  EXPECT_EQ(parse_config("", "f").text, parse_config(paper_text(), "f").text);
  EXPECT_EQ(default_configuration(), paper_text());
  const Config config = parse_config("[learner]\ngamma = 0.5\n", "f");
  EXPECT_EQ(config.learner.gamma, 0.5);
  EXPECT_EQ(parse_config(config.text, "g").text, config.text);
  EXPECT_EQ(parse_config(config.text, "g").learner.gamma, 0.5);
}

// A configuration is known by its text's hash, which exported headers carry: the default kind of task, which
// older texts did not name, stands in none.
TEST(Config, TheCommittedPoliciesConfigurationsAreStillTheirOwn) {
  const std::filesystem::path configs = STRIKER_CONFIGS;
  const Config kick = load_config(configs / "kick.toml");
  EXPECT_EQ(fnv1a(kick.text), policy::kick.configuration_hash);
  EXPECT_EQ(fnv1a(load_config(configs / "kick_dqn.toml").text), policy::kick_dqn.configuration_hash);
  EXPECT_EQ(fnv1a(load_config(configs / "aimed.toml").text), policy::aimed.configuration_hash);
  EXPECT_EQ(kick.environments.front().kind, TaskKind::kick);
  EXPECT_EQ(parse_config("[task]\nkind = \"kick\"\n", "f").text, parse_config("", "f").text);
}

// An aimed kick's contact is paid by the task itself.
TEST(Config, AnAimedKickReadsNoRewardsOfTheContact) {
  const Config aimed = parse_config("[task]\nkind = \"aimed\"\n", "f");
  EXPECT_EQ(aimed.environments.front().rules.reward, sil::KickReward::aimed);
  EXPECT_EQ(parse_config(aimed.text, "g").text, aimed.text);
  EXPECT_EQ(parse_config("[task]\nkind = \"aimed\"\n[reward]\nwaiting = -0.2\n", "f")
                .environments.front()
                .rules.waiting_reward,
            -0.2);
  for (const char* rewards : {"angle = 2.0", "speed = 3.0", "contact_speed = \"unsigned\"",
                              "contacts = \"every\"", "after_contact = \"go on\""}) {
    const std::string text = std::string("[task]\nkind = \"aimed\"\n[reward]\n") + rewards + "\n";
    expect_refused([&] { (void)parse_config(text, "some.toml"); }, "some.toml", {"reward.", "task.kind"});
  }
}

// The forward's table stands in no text; another robot's does, with the actions that follow from it.
TEST(Config, ARobotStandsInTheTextUnlessItIsTheForward) {
  const Config paper = parse_config("", "f");
  EXPECT_EQ(paper.environments.front().robot, core::forward);
  EXPECT_EQ(paper.text.find("robot"), paper.text.find("robot_speed"));
  EXPECT_EQ(parse_config("[robot]\nbody_mass_g = 1500\n", "f").text, paper.text);
  EXPECT_EQ(parse_config("", "f", robot_changes(core::forward)).text, paper.text);
  for (const core::RobotDescription& robot : {core::goalkeeper, core::defender}) {
    const Config config = parse_config("", "f", robot_changes(robot));
    const Config again = parse_config(config.text, "g");
    EXPECT_EQ(again.text, config.text);
    EXPECT_EQ(again.environments.front().robot, robot);
    EXPECT_EQ(again.environments.front().actions, kick_actions(robot));
    EXPECT_EQ(changed_keys(paper.text, config.text).size(), core::robot_keys.size() + 1) << config.text;
  }
}

TEST(Config, TheActionsAreTheRobotsUnlessTheyAreNamed) {
  const std::string slower = "[robot]\ntop_rim_speed_mm_s = 1800\n";
  EXPECT_EQ(parse_config(slower, "f").environments.front().actions,
            (std::vector<SetPoint>{{1.8, 1.8}, {0.0, 0.0}, {-1.8, -1.8}}));
  const std::vector<SetPoint> named = {{1.0, 1.0}, {0.0, 0.0}};
  EXPECT_EQ(
      parse_config(slower + "[task]\nactions = [[1.0, 1.0], [0.0, 0.0]]\n", "f").environments.front().actions,
      named);
  EXPECT_EQ(parse_config(slower, "f", {"task.actions=[[1.0, 1.0], [0.0, 0.0]]"}).environments.front().actions,
            named);
}

TEST(Config, TheTimeLimitStandsInTheTextOnlyWhereItIsOn) {
  EXPECT_EQ(parse_config("[learner]\ntime_limit = false\n", "f").text, parse_config("", "f").text);
  const Config on = parse_config("[learner]\ntime_limit = true\n", "f");
  EXPECT_TRUE(on.learner.time_limit);
  EXPECT_NE(on.text, parse_config("", "f").text);
  EXPECT_TRUE(parse_config(on.text, "g").learner.time_limit);
}

TEST(Config, ChangesOverrideTheFile) {
  const std::string file = "[learner]\ngamma = 0.5\n";
  EXPECT_EQ(parse_config(file, "f", {"learner.gamma=0.75", "run.episodes = 7"}).learner.gamma, 0.75);
  EXPECT_EQ(parse_config(file, "f", {"run.episodes=7"}).run.episodes, 7);
  EXPECT_THROW((void)parse_config(file, "f", {"learner.gama=0.75"}), std::runtime_error);
  EXPECT_THROW((void)parse_config(file, "f", {"learner.gamma"}), std::runtime_error);
}

TEST(Config, InputsMayBeDummiesAndPast) {
  const Config config = parse_config("[task]\ninputs = [\"ball_x\", \"robot_speed@2\"]\ndummies = 3\n", "f");
  const StateInputs expected = {{.element = Element::ball_x},
                                {.element = Element::robot_speed, .decisions_ago = 2},
                                {.element = Element::dummy},
                                {.element = Element::dummy},
                                {.element = Element::dummy}};
  EXPECT_EQ(config.environments.front().inputs, expected);
  EXPECT_EQ(config.shape.inputs, 5);
}

// Mirrored samples need inputs and actions that have a mirror image.
TEST(Config, TheMirrorNeedsAnImage) {
  const std::string mirror = "[learner]\nmirror = true\n";
  EXPECT_THROW((void)parse_config(mirror + "[task]\ninputs = \"acs\"\n", "f"), std::runtime_error);
  EXPECT_THROW((void)parse_config("[task]\nmirrored = true\ninputs = \"acs\"\n", "f"), std::runtime_error);
  EXPECT_THROW((void)parse_config(mirror + "[task]\nactions = [[1.0, 2.0], [0.0, 0.0]]\n", "f"),
               std::runtime_error);
  const Config turning =
      parse_config(mirror + "[task]\nactions = [[1.0, 2.0], [0.0, 0.0], [2.0, 1.0]]\n", "f");
  const auto& actions = turning.environments.front().actions;
  EXPECT_EQ(mirrored_action(actions, 0), 2);
  EXPECT_EQ(mirrored_action(actions, 1), 1);
}

TEST(Config, WholeNumbersServeWhereFractionsMay) {
  EXPECT_EQ(parse_config(replaced(paper_text(), "gamma = 0.95", "gamma = 1"), "f").learner.gamma, 1.0);
}

TEST(Config, AMissingFileIsNamed) {
  try {
    (void)load_config("/no/such/file.toml");
    FAIL() << "was read";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/file.toml"), std::string::npos);
  }
}

}  // namespace
}  // namespace striker::training
