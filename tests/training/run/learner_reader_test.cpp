// SPDX-License-Identifier: Apache-2.0
// The learner from own rollouts in a configuration: what is wrong is named, with the way out.
#include "training/run/learner_reader.hpp"

#include "tests/training/fixtures.hpp"

namespace striker::training {
namespace {

struct Wrong {
  const char* name;
  const char* text;
  std::vector<const char*> complaints;
};

const std::vector<Wrong> wrong = {
    {"UnknownKind", "[learner]\nkind = \"sarsa\"\n", {"learner.kind = 'sarsa'", "\"dqn\" or \"rollout\""}},
    {"ADqnKey",
     "[learner]\nkind = \"rollout\"\ngamma = 0.9\n",
     {"learner.gamma = 0.9", "learner.kind = \"dqn\"", "leave it out"}},
    {"ARolloutKey", "[rollout]\nfocus = 2.0\n", {"rollout.focus = 2", "learner.kind = \"rollout\""}},
    {"RandomisedDqn", "[randomise]\nshare = 0.5\n", {"randomise.share = 0.5", "learner.kind = \"rollout\""}},
    {"GuidedDqn",
     "[rollout]\nguided_share = 0.1\n",
     {"rollout.guided_share = 0.1", "learner.kind = \"rollout\""}},
    {"GuidedByMoreThanAll",
     "[learner]\nkind = \"rollout\"\n[rollout]\nguided_share = 1.5\n",
     {"rollout.guided_share = 1.5", "0 to 1"}},
    {"GuidedByOtherActions",
     "[learner]\nkind = \"rollout\"\n[rollout]\nguided_share = 0.1\n[task]\nactions = [[1.0, 1.0], [0.0, 0.0]]\n",
     {"task.actions", "rollout.guided_share", "forward, stop and backward"}},
    {"GuidedToOtherRewards",
     "[learner]\nkind = \"rollout\"\n[rollout]\nguided_share = 0.1\n[reward]\nangle = 2.0\n",
     {"reward.angle = 2", "rollout.guided_share", "the default"}},
    {"NoRound",
     "[learner]\nkind = \"rollout\"\n[rollout]\nround = 0\n",
     {"rollout.round = 0", "1 to 100000"}},
    {"NoTemperature",
     "[learner]\nkind = \"rollout\"\n[rollout]\ntemperature = 0.0\n",
     {"rollout.temperature = 0", "0.001 to 100"}},
    {"NoPasses", "[learner]\nkind = \"rollout\"\n[rollout]\npasses = 0.0\n", {"rollout.passes = 0", "0.01"}},
    {"LittleFocus",
     "[learner]\nkind = \"rollout\"\n[rollout]\nfocus = 0.5\n",
     {"rollout.focus = 0.5", "1 to 100"}},
    {"FullWorld",
     "[learner]\nkind = \"rollout\"\n[task]\nworld = \"full\"\n",
     {"task.world = 'full'", "\"fast\""}},
    {"Anywhere",
     "[learner]\nkind = \"rollout\"\n[task]\npose = \"anywhere\"\n",
     {"task.pose = 'anywhere'", "\"origin\""}},
    {"FieldInputs",
     "[learner]\nkind = \"rollout\"\n[task]\ninputs = \"acs\"\n",
     {"task.inputs = 'acs'", "the controller has"}},
    {"TurningActions",
     "[learner]\nkind = \"rollout\"\n[task]\nactions = [[1.0, 1.0], [1.0, -1.0]]\n",
     {"task.actions", "both wheels"}},
    {"ItGoesOn",
     "[learner]\nkind = \"rollout\"\n[reward]\nafter_contact = \"go on\"\n",
     {"reward.after_contact = 'go on'", "\"end\""}},
    {"RangeTurned",
     "[learner]\nkind = \"rollout\"\n[randomise]\nmass = [0.3, -0.3]\n",
     {"randomise.mass", "lower number"}},
    {"NoMass",
     "[learner]\nkind = \"rollout\"\n[randomise]\nmass = [-1.0, 0.0]\n",
     {"randomise.mass", "-0.9 to 9"}},
    {"LongDelay",
     "[learner]\nkind = \"rollout\"\n[randomise]\ncommand_delay_ms = [0.0, 60.0]\n",
     {"randomise.command_delay_ms", "0 to 50"}},
};

class WrongLearner : public testing::TestWithParam<Wrong> {};

TEST_P(WrongLearner, IsRefusedByName) {
  expect_refused([] { (void)parse_config(GetParam().text, "some.toml"); }, "some.toml",
                 GetParam().complaints);
}

INSTANTIATE_TEST_SUITE_P(LearnerReader, WrongLearner, testing::ValuesIn(wrong),
                         [](const auto& tested) { return tested.param.name; });

TEST(LearnerReader, TheCommittedOnesAreRead) {
  const std::filesystem::path configs = STRIKER_CONFIGS;
  const Config kick = load_config(configs / "kick.toml");
  EXPECT_EQ(kick.learner.kind, LearnerKind::rollout);
  EXPECT_EQ(kick.environments.front().actions,
            load_config(configs / "kick_dqn.toml").environments.front().actions);
  EXPECT_EQ(load_config(configs / "kick_dqn.toml").learner.kind, LearnerKind::dqn);
  const Config paper = load_config(configs / "paper_rollout.toml");
  EXPECT_EQ(paper.environments.front().inputs, rcs_inputs());
  EXPECT_EQ(paper.shape, Shape{});
  EXPECT_EQ(load_config(configs / "paper.toml").learner.kind, LearnerKind::dqn);
}

// The text of a DQN names none of the other learner's keys; that of the other one names all, and is read again.
TEST(LearnerReader, TheTextNamesWhatTheLearnerReads) {
  EXPECT_EQ(parse_config("", "f").text.find("rollout"), std::string::npos);
  EXPECT_EQ(parse_config("", "f").text.find("randomise"), std::string::npos);
  EXPECT_EQ(parse_config("[learner]\nkind = \"dqn\"\n", "f").text, parse_config("", "f").text);
  const Config config = parse_config("[learner]\nkind = \"rollout\"\n[randomise]\nmass = [-0.3, 0.2]\n", "f");
  EXPECT_EQ(parse_config(config.text, "g").text, config.text);
  EXPECT_EQ(parse_config(config.text, "g").environments.front().randomise.mass.low, -0.3);
}

}  // namespace
}  // namespace striker::training
