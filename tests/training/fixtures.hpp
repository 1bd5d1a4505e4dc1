// SPDX-License-Identifier: Apache-2.0
// What several of these tests need.
#pragma once

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "training/model/model.hpp"
#include "training/run/config.hpp"
#include "training/run/training_run.hpp"

namespace striker::training {

// A directory of its own for the running test, removed at the end.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '-');
    path_ = std::filesystem::temp_directory_path() / ("striker-" + name + "-" + std::to_string(getpid()));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] std::string string() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void write_to(const std::filesystem::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

// `read` refuses the file in one line that begins with its name and holds every one of the complaints.
template <class Read>
void expect_refused(const Read& read, const std::string& file, const std::vector<const char*>& complaints) {
  try {
    read();
    FAIL() << "was read";
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find(file + ": "), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const char* complaint : complaints) {
      EXPECT_NE(message.find(complaint), std::string::npos) << message;
    }
  }
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline std::string paper_text() {
  return content_of(std::filesystem::path(STRIKER_CONFIGS) / "paper.toml");
}

// The paper's learner on a run of seconds, with every option that adds code switched on.
inline Config short_config(int episodes) {
  Config config = parse_config(paper_text(), "short.toml");
  config.environments = {{}, {.velocities = Velocities::estimated}};
  config.run.episodes = episodes;
  config.run.validation_episodes = 0;
  config.learner.double_dqn = true;
  config.learner.augment_mirrored = true;
  config.learner.n_step = 5;
  config.learner.warm_up = 200;
  config.learner.replay_size = 1000;
  config.learner.target_period = 100;
  return config;
}

// A whole training in memory.
inline std::vector<CurveRow> play_all(Training& training) {
  std::vector<CurveRow> rows;
  while (!training.done()) {
    for (const CurveRow& row : training.play_round()) {
      rows.push_back(row);
    }
  }
  return rows;
}

// Weights like a trained network's, in size.
inline Parameters some_parameters(unsigned seed, const Shape& shape = {}) {
  Parameters parameters = initial_parameters(shape, seed);
  std::mt19937 random(seed);
  std::normal_distribution<float> bias(0.0F, 0.1F);
  for (int layer = 0; layer + 1 < shape.layers(); ++layer) {
    for (float& b : parameters.biases(layer)) {
      b = bias(random);
    }
  }
  return parameters;
}

inline Parameters scaled(Parameters parameters, float factor) {
  parameters.values *= factor;
  return parameters;
}

inline RawState some_state(std::mt19937& random) {
  const auto draw = [&random](int limit) {
    return std::uniform_int_distribution<int>(-limit, limit)(random);
  };
  return {draw(2'500'000), draw(2'500'000), draw(2'550), draw(3'000), draw(3'000), draw(32'767)};
}

}  // namespace striker::training
