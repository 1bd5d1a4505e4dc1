// SPDX-License-Identifier: Apache-2.0
// How --help is laid out: what the program is for, how it is called, its options, and last the exit statuses, within
// 100 columns. What of a description begins with "Exit status" goes to the end.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <string_view>

namespace striker::host {

inline constexpr std::size_t help_columns = 100;

// The words of a text in lines of at most so many columns, each but the first behind `indent` blanks. A longer word has
// a line of its own.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t columns, std::size_t indent = 0);

class HelpText : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_description(const CLI::App* app) const override;
  [[nodiscard]] std::string make_footer(const CLI::App* app) const override;
  [[nodiscard]] std::string make_subcommand(const CLI::App* app) const override;
  [[nodiscard]] std::string make_option(const CLI::Option* option, bool is_positional) const override;
};

}  // namespace striker::host
