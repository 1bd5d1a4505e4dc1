// SPDX-License-Identifier: Apache-2.0
// What the command lines of all programs on a host have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <initializer_list>
#include <string>

namespace striker::host {

// Exit statuses: wrong use or an input that cannot be used; a stop signal that ended the work early.
inline constexpr int exit_bad_input = 2;
inline constexpr int exit_interrupted = 130;

// Parses, runs `body` and returns the exit code. A wrong option and an exception end in one line on stderr
// and code 2, as does output that standard output did not take. Adds --version: program, version, commit, build
// type, and `built_in`, which a program names that has more to tell of itself, such as its policy.
//
// All of them: options may stand before and behind a subcommand; a number is a finite one, whole where it counts,
// and no other than was written; a name that is not known is answered with the nearest one that is.
int run(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& body,
        const std::string& built_in = "");

// For a final callback: refuses those of the options that were given, unless they mean something with the others.
// `what` says with which: "--clock realtime".
void require_meaning(CLI::App& app, bool has_meaning, std::initializer_list<const char*> options,
                     const std::string& what);

// Of an option that names a file which the program writes, or reads. Before the body runs, an empty name, a folder
// and a place that cannot be written are refused, and so is a file that would be both, or written twice.
CLI::Option* writes_file(CLI::Option* option);
CLI::Option* reads_file(CLI::Option* option);

}  // namespace striker::host
