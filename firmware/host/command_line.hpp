// SPDX-License-Identifier: Apache-2.0
// What the command lines of all programs on a host have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace striker::host {

// Exit statuses: wrong use or an input that cannot be used; a stop signal that ended the work early.
inline constexpr int exit_bad_input = 2;
inline constexpr int exit_interrupted = 130;

// Parses, runs `body` and returns the exit code. A wrong option and an exception end in one line on stderr
// and code 2. Adds --version: program, version, commit, build type, and `built_in`, which a program names that
// has more to tell of itself, such as its policy.
int run(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& body,
        const std::string& built_in = "");

// For an option that is a floating-point number: it goes from `least` to `greatest`, both finite, and so is no NaN,
// which CLI::Range lets pass.
[[nodiscard]] CLI::Validator finite_range(double least, double greatest);

// For an option that names a file: it is not "".
[[nodiscard]] CLI::Validator not_empty();

}  // namespace striker::host
