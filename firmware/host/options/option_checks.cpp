// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/options/option_checks.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <string_view>
#include <utility>

namespace striker::host {

namespace {

namespace fs = std::filesystem;

template <class Number>
bool reads_as(std::string_view text) {
  text.remove_prefix(text.starts_with('+') ? 1 : 0);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

// The library reads -1 and what is too large as some unsigned number, and "nan" passes its ranges.
std::string number_problem(std::string_view type, const std::string& text) {
  if (type.starts_with("UINT") && !reads_as<std::uint64_t>(text)) {
    return fmt::format("'{}' is no whole number from 0 to {}", text, UINT64_MAX);
  }
  if (type.starts_with("INT") && !reads_as<std::int64_t>(text)) {
    return fmt::format("'{}' is no whole number from {} to {}", text, INT64_MIN, INT64_MAX);
  }
  double value = 0.0;
  if (type.starts_with("FLOAT") && (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value))) {
    return fmt::format("'{}' is no finite number", text);
  }
  return {};
}

std::size_t edit_distance(std::string_view one, std::string_view other) {
  std::vector<std::size_t> row(other.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char letter : one) {
    std::size_t diagonal = row[0]++;
    for (std::size_t i = 0; i < other.size(); ++i) {
      const std::size_t replaced = diagonal + (letter == other[i] ? 0 : 1);
      diagonal = row[i + 1];
      row[i + 1] = std::min({replaced, row[i] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::vector<std::string> known_names(CLI::App& app) {
  std::vector<std::string> names;
  for (CLI::App* const one : with_subcommands(app)) {
    if (one != &app) {
      names.push_back(one->get_name());
    }
    for (const CLI::Option* const option : one->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        names.push_back("--" + name);
      }
    }
  }
  return names;
}

struct NamedFile {
  std::string option;
  fs::path file;
  bool written;
};

std::vector<NamedFile> named_files(CLI::App& app) {
  std::vector<NamedFile> files;
  for (CLI::App* const one : with_subcommands(app)) {
    for (const CLI::Option* const option : one->get_options()) {
      const std::string type = option->get_type_name();
      const bool written = type.starts_with(written_file);
      if (!written && !type.starts_with(read_file_name)) {
        continue;
      }
      for (const std::string& name : option->results()) {
        std::error_code unresolved;
        files.push_back({option->get_name(), fs::weakly_canonical(name, unresolved), written});
      }
    }
  }
  return files;
}

}  // namespace

std::string output_problem(const std::string& name) {
  if (name.empty()) {
    return "is empty: name a file to write";
  }
  const fs::path file(name);
  std::error_code unknown;
  if (fs::is_directory(file, unknown)) {
    return fmt::format("{}: is a folder: name a file in it", name);
  }
  const fs::path parent = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(parent, unknown)) {
    return fmt::format("{}: there is no folder {}: make it first", name, parent.string());
  }
  const bool replaces = !fs::exists(file, unknown) || fs::is_regular_file(file, unknown);
  const fs::path& written = replaces ? parent : file;
  return access(written.c_str(), W_OK) == 0
             ? std::string()
             : fmt::format("{}: cannot be written: name a file in a writable folder", name);
}

std::string input_problem(const std::string& name) {
  if (name.empty()) {
    return "is empty: name a file to read";
  }
  std::error_code unknown;
  if (fs::is_directory(name, unknown)) {
    return fmt::format("{}: is a folder: name a file in it", name);
  }
  return access(name.c_str(), R_OK) == 0 ? std::string()
                                         : fmt::format("{}: cannot be read: name a file that is there", name);
}

std::vector<CLI::App*> with_subcommands(CLI::App& app) {
  std::vector<CLI::App*> apps = app.get_subcommands([](const CLI::App*) { return true; });
  apps.insert(apps.begin(), &app);
  return apps;
}

void check_numbers(CLI::App& app) {
  for (CLI::App* const one : with_subcommands(app)) {
    for (CLI::Option* const option : one->get_options()) {
      const std::string type = option->get_type_name();
      option->check(
          CLI::Validator([type](const std::string& text) { return number_problem(type, text); }, ""));
    }
  }
}

void require_distinct_files(CLI::App& app) {
  const std::vector<NamedFile> files = named_files(app);
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const bool is_plain = !fs::exists(files[i].file) || fs::is_regular_file(files[i].file);
      if (is_plain && files[i].file == files[k].file && (files[i].written || files[k].written)) {
        throw CLI::ValidationError(files[i].option, fmt::format("{} is {} too: name two files",
                                                                files[i].file.string(), files[k].option));
      }
    }
  }
}

std::string nearest_name(CLI::App& app, const std::vector<std::string>& arguments) {
  const std::vector<std::string> names = known_names(app);
  for (const std::string& argument : arguments) {
    const std::string given = argument.substr(0, argument.find('='));
    const auto distance = [&](const std::string& name) { return edit_distance(given, name); };
    const auto nearest = std::min_element(
        names.begin(), names.end(),
        [&](const std::string& one, const std::string& other) { return distance(one) < distance(other); });
    const std::size_t most = std::max<std::size_t>(2, given.size() / 3);
    if (nearest != names.end() && distance(*nearest) != 0 && distance(*nearest) <= most) {
      return fmt::format(": did you mean {}?", *nearest);
    }
  }
  return {};
}

}  // namespace striker::host
