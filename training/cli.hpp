// What the training programs' command lines have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace striker::training {

inline constexpr int exit_bad_input = 2;

// Parses, runs `body` and returns the exit code. A wrong option and an exception end in one line on stderr
// and code 2.
int run(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& body);

}  // namespace striker::training
