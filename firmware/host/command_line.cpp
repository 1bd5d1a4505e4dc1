// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/command_line.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <memory>
#include <vector>

#include "firmware/host/options/help_text.hpp"
#include "firmware/host/options/option_checks.hpp"
#include "firmware/host/version.hpp"

namespace striker::host {

namespace {

// A result that nobody could read is none.
int with_output_written(const std::string& program, int status) {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) {
    return status;
  }
  fmt::print(stderr, "{}: standard output cannot be written: {}\n", program,
             errno != 0 ? std::strerror(errno) : "is the disk full?");
  return exit_bad_input;
}

int refuse(CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  const bool is_unknown = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                          dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  fmt::print(stderr, "{}: {}{}; see {} --help\n", app.get_name(), error.what(),
             is_unknown ? nearest_name(app, arguments) : "", app.get_name());
  return exit_bad_input;
}

}  // namespace

int run(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& body,
        const std::string& built_in) {
  app.set_version_flag("--version", fmt::format("{} {} ({}, {}){}{}", app.get_name(), version(), git_hash(),
                                                build_type(), built_in.empty() ? "" : ", ", built_in));
  for (CLI::App* const one : with_subcommands(app)) {
    one->fallthrough();
    one->formatter(std::make_shared<HelpText>());
  }
  check_numbers(app);
  try {
    app.parse(argc, argv);
    require_distinct_files(app);
  } catch (const CLI::Success& help) {
    return with_output_written(app.get_name(), app.exit(help));
  } catch (const CLI::ParseError& error) {
    return refuse(app, error, argc, argv);
  }
  try {
    return with_output_written(app.get_name(), body());
  } catch (const std::exception& error) {
    std::fflush(stdout);
    fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
    return exit_bad_input;
  }
}

void require_meaning(CLI::App& app, bool has_meaning, std::initializer_list<const char*> options,
                     const std::string& what) {
  for (const char* const option : options) {
    if (!has_meaning && app.count(option) != 0) {
      throw CLI::ValidationError(option, fmt::format("means nothing but with {}: leave it out", what));
    }
  }
}

CLI::Option* writes_file(CLI::Option* option) {
  return option->type_name(written_file)->check(CLI::Validator(output_problem, ""));
}

CLI::Option* reads_file(CLI::Option* option) {
  return option->type_name(read_file_name)->check(CLI::Validator(input_problem, ""));
}

}  // namespace striker::host
