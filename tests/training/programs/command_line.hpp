// SPDX-License-Identifier: Apache-2.0
// Runs a program as a user does.
#pragma once

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>

#include "tests/training/fixtures.hpp"

namespace striker::training {

struct Result {
  int code = -1;
  std::string out;
  std::string err;
};

class CommandLine : public testing::Test {
 protected:
  Result run(const std::string& command) {
    const auto out = directory_ / "out.txt";
    const auto err = directory_ / "err.txt";
    const int status = std::system(fmt::format("{} > {} 2> {}", command, out.string(), err.string()).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(out), content_of(err)};
  }

  // Fails with code 2 and one line that holds `complaint`.
  void expect_refusal(const std::string& command, const std::string& complaint) {
    const Result result = run(command);
    EXPECT_EQ(result.code, 2) << command;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(complaint), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  }

  [[nodiscard]] std::string path(const std::string& name) const { return (directory_ / name).string(); }

  // A configuration of a second, on disk.
  std::string quick_config() {
    std::string text = replaced(paper_text(), "\nepisodes = 5000", "\nepisodes = 30");
    text = replaced(text, "validation_episodes = 1000", "validation_episodes = 20");
    text = replaced(text, "warm_up = 1000", "warm_up = 200");
    write_to(path("quick.toml"), text);
    return path("quick.toml");
  }

  std::string a_model() {
    save_model({.parameters = some_parameters(1), .metadata = {{"seed", "1"}}}, path("model.safetensors"));
    return path("model.safetensors");
  }

  TemporaryDirectory directory_;
};

}  // namespace striker::training
