// SPDX-License-Identifier: Apache-2.0
// What may change in a training that goes on.
#include "training/run/config_changes.hpp"

#include "tests/training/fixtures.hpp"

namespace striker::training {
namespace {

std::vector<ChangedKey> changes_by(const std::vector<std::string>& settings) {
  return changed_keys(parse_config("", "f").text, parse_config("", "f", settings).text);
}

TEST(ConfigChanges, AreFoundByKeyAndValue) {
  EXPECT_TRUE(changes_by({}).empty());
  EXPECT_TRUE(changes_by({"learner.gamma=0.95"}).empty());
  EXPECT_EQ(text_of(changes_by({"run.episodes=7", "optimiser.learning_rate=0.001"})),
            "optimiser.learning_rate 0.002 -> 0.001, run.episodes 5000 -> 7");
  EXPECT_EQ(text_of(changes_by({"learner.time_limit=true"})), "learner.time_limit its default -> true");
}

TEST(ConfigChanges, OnlySomeMayChange) {
  EXPECT_NO_THROW(require_may_change(changes_by({"run.episodes=7", "exploration.epsilon_end=0.01"})));
  for (const char* change : {"learner.gamma=0.9", "learner.n_step=2", "learner.replay_size=100",
                             "learner.time_limit=true", "learner.prioritised=true", "optimiser.averaging=0.0",
                             "network.hidden=[8, 8]", "network.dueling=true", "task.velocities=\"both\"",
                             "ball.aim_radius_m=1.0", "reward.waiting=0.0", "run.validation_episodes=3"}) {
    const std::string key = std::string(change).substr(0, std::string(change).find('='));
    try {
      require_may_change(changes_by({change}));
      FAIL() << change;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find(key + " was "), 0U) << error.what();
      EXPECT_NE(std::string(error.what()).find("optimiser.learning_rate"), std::string::npos) << error.what();
    }
  }
}

// Every key that may change is one of a configuration.
TEST(ConfigChanges, TheKeysThatMayChangeExist) {
  const auto all = changed_keys("", parse_config("", "f").text);
  const auto count =
      std::count_if(all.begin(), all.end(), [](const ChangedKey& change) { return may_change(change.key); });
  EXPECT_EQ(count, 17);
}

}  // namespace
}  // namespace striker::training
