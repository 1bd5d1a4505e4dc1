// SPDX-License-Identifier: Apache-2.0
// What host::run asks of every option (command_line.hpp).
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace striker::host {

inline constexpr const char* written_file = "OUT-FILE";
inline constexpr const char* read_file_name = "IN-FILE";

// An empty string: nothing is wrong with it.
[[nodiscard]] std::string output_problem(const std::string& name);
[[nodiscard]] std::string input_problem(const std::string& name);

// The app and its subcommands, whether given or not.
[[nodiscard]] std::vector<CLI::App*> with_subcommands(CLI::App& app);

// Adds to every numeric option that it is written as such a number.
void check_numbers(CLI::App& app);

// After parsing: two options that name one file, of which one is written. Throws CLI::ValidationError.
void require_distinct_files(CLI::App& app);

// ": did you mean --NAME?" for the first of these arguments that is not known, or nothing.
[[nodiscard]] std::string nearest_name(CLI::App& app, const std::vector<std::string>& arguments);

}  // namespace striker::host
