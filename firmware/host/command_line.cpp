// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/command_line.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "firmware/host/version.hpp"

namespace striker::host {

int run(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& body,
        const std::string& built_in) {
  app.set_version_flag("--version", fmt::format("{} {} ({}, {}){}{}", app.get_name(), version(), git_hash(),
                                                build_type(), built_in.empty() ? "" : ", ", built_in));
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "{}: {}; see {} --help\n", app.get_name(), error.what(), app.get_name());
    return exit_bad_input;
  }
  try {
    return body();
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
    return exit_bad_input;
  }
}

CLI::Validator finite_range(double least, double greatest) {
  const std::string range = fmt::format("[{:.12g} - {:.12g}]", least, greatest);
  const auto problem = [=](const std::string& text) {
    double value = 0.0;
    return CLI::detail::lexical_cast(text, value) && value >= least && value <= greatest  // NaN is neither
               ? std::string()
               : fmt::format("'{}' is no number from {:.12g} to {:.12g}", text, least, greatest);
  };
  return {problem, "FLOAT in " + range};
}

CLI::Validator not_empty() {
  return {[](const std::string& text) {
            return text.empty() ? std::string("is empty: name a file") : std::string();
          },
          "FILE"};
}

}  // namespace striker::host
