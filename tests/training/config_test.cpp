// The configuration: what is wrong is named.
#include "config.hpp"

#include "fixtures.hpp"

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
    {"MissingKey", "n_step = 1", "", {"learner.n_step is missing"}},
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
    {"NotANumber", "learning_rate = 1e-3", "learning_rate = nan", {"optimiser.learning_rate = nan"}},
    {"NoToml", "[optimiser]", "[optimiser", {"line "}},
};

class WrongConfig : public testing::TestWithParam<Wrong> {};

TEST_P(WrongConfig, IsRefusedByName) {
  const std::string text = replaced(paper_text(), GetParam().from, GetParam().to);
  try {
    (void)parse_config(text, "some.toml");
    FAIL() << "was read";
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("some.toml: "), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const char* complaint : GetParam().complaints) {
      EXPECT_NE(message.find(complaint), std::string::npos) << message;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Config, WrongConfig, testing::ValuesIn(wrong),
                         [](const auto& tested) { return tested.param.name; });

TEST(Config, TheCommittedOnesAreRead) {
  const std::filesystem::path configs = STRIKER_CONFIGS;
  const Config paper = load_config(configs / "paper.toml");
  EXPECT_EQ(paper.name, "paper");
  EXPECT_EQ(paper.text, paper_text());
  EXPECT_EQ(paper.episodes, 5000);
  EXPECT_EQ(paper.learner.n_step, 1);
  EXPECT_FALSE(paper.learner.double_dqn);
  EXPECT_EQ(paper.environments.size(), 1U);
  EXPECT_EQ(load_config(configs / "kick.toml").name, "kick");
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
