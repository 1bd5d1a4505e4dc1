// SPDX-License-Identifier: Apache-2.0
#include "sil/policy/policy_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <string>

#include "firmware/host/temporary_directory.hpp"

namespace striker::sil {

namespace {

// Its exit status, without its standard output.
int run(const std::array<std::string, 5>& words) {
  std::array<char*, 6> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    arguments[i] = const_cast<char*>(words[i].c_str());
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw std::runtime_error(
        fmt::format("{}: it makes a header of a model, and cannot be run: build it too", words[0]));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

}  // namespace

LoadedPolicy load_policy(const std::filesystem::path& file) {
  if (file.extension() == ".hpp") {
    return read_policy_header(file);
  }
  const host::TemporaryDirectory directory;
  const std::filesystem::path header = directory.path() / "policy.hpp";
  const auto exporter = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "striker-export";
  if (run({exporter.string(), "--output", header.string(), "--", file.string()}) != 0) {
    throw std::runtime_error(fmt::format(
        "{}: striker-export made no header of it; if it takes an option of its own, make one with that and give it",
        file.string()));
  }
  LoadedPolicy policy = read_policy_header(header);
  policy.name = file.stem().string();
  return policy;
}

}  // namespace striker::sil
