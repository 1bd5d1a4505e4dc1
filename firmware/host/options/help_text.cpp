// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/options/help_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>
#include <vector>

namespace striker::host {

namespace {

constexpr std::size_t text_column = 30;
constexpr std::string_view last_part = "Exit status";

// "UINT:UINT in [1 - 100]": what is given, and what is asked of it.
struct Value {
  std::string shape;
  std::string limits;
};

Value value_of(const std::string& type) {
  const std::size_t colon = type.find(':');
  const std::string name = type.substr(0, colon);
  const std::string asked = colon == std::string::npos ? "" : type.substr(colon + 1);
  std::smatch range;
  Value value{.shape = name == "UINT" || name == "INT" ? "N" : name == "FLOAT" ? "X" : name, .limits = {}};
  if (std::regex_match(asked, range, std::regex(R"(.* in \[(.*) - (.*)\])"))) {
    value.limits = fmt::format("{} to {}", range.str(1), range.str(2));
  } else if (asked.starts_with('{')) {
    value.shape = asked.substr(1, asked.size() - 2);
    std::replace(value.shape.begin(), value.shape.end(), ',', '|');
  } else {
    value.limits = asked;
  }
  return value;
}

std::string line_of(const std::string& left, std::string_view text) {
  const std::string begin = "  " + left;
  const std::string gap = begin.size() + 2 > text_column ? "\n" + std::string(text_column, ' ')
                                                         : std::string(text_column - begin.size(), ' ');
  return begin + gap + wrapped(text, help_columns - text_column, text_column) + "\n";
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t columns, std::size_t indent) {
  std::istringstream words{std::string(text)};
  std::string result;
  std::string word;
  std::size_t used = 0;
  while (words >> word) {
    if (used != 0 && used + 1 + word.size() > columns) {
      result += "\n" + std::string(indent, ' ');
      used = 0;
    }
    result += used != 0 ? " " : "";
    used += (used != 0 ? 1 : 0) + word.size();
    result += word;
  }
  return result;
}

std::string HelpText::make_description(const CLI::App* app) const {
  std::string text = app->get_description();
  text = text.substr(0, text.find(last_part));
  if (!text.empty()) {
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  }
  return wrapped(text, help_columns) + "\n\n";
}

std::string HelpText::make_footer(const CLI::App* app) const {
  const std::string text = app->get_description();
  const std::size_t last = text.find(last_part);
  const std::string all = (last == std::string::npos ? "" : text.substr(last) + " ") + app->get_footer();
  return all.empty() ? "" : wrapped(all, help_columns) + "\n";
}

std::string HelpText::make_subcommand(const CLI::App* app) const {
  return line_of(app->get_name(), app->get_description());
}

std::string HelpText::make_option(const CLI::Option* option, bool is_positional) const {
  std::string left = option->get_name(is_positional, !is_positional);
  std::vector<std::string> notes;
  if (option->get_type_size() != 0) {
    const Value value = value_of(option->get_type_name());
    left += is_positional || value.shape.empty() ? "" : " " + value.shape;
    if (!value.limits.empty()) {
      notes.push_back(value.limits);
    }
    if (!option->get_default_str().empty()) {
      notes.push_back("default " + option->get_default_str());
    }
  }
  if (option->get_required()) {
    notes.emplace_back("required");
  }
  const std::string& text = option->get_description();
  return line_of(left, notes.empty() ? text : fmt::format("{} ({})", text, fmt::join(notes, "; ")));
}

}  // namespace striker::host
