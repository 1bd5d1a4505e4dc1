// SPDX-License-Identifier: Apache-2.0
// Reads the values of a TOML table, and says what is wrong with one: file, key, value, and what it may be.
#pragma once

#include <fmt/format.h>

#include <toml++/toml.h>
#include <cstdint>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "training/model/shown.hpp"

namespace striker::training {

// What a text may be, and what each means.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

// Every key stands in the table, so that reading can only fail by the value: std::runtime_error with one
// line. The table must outlive the reader.
class TomlReader {
 public:
  TomlReader(const toml::table& root, std::string file) : root_(root), file_(std::move(file)) {}

  void read(const std::string& key, int& value, int least, int greatest) const {
    value = whole(key, node(key), least, greatest);
  }

  void read(const std::string& key, double& value, double least, double greatest) const {
    value = number(key, node(key), least, greatest);
  }

  void read(const std::string& key, bool& value) const {
    const auto read = node(key).value_exact<bool>();
    if (!read) {
      fail(key, "must be true or false");
    }
    value = *read;
  }

  template <class Value>
  void read(const std::string& key, Value& value, const Choices<Value>& choices) const {
    const auto read = node(key).value_exact<std::string>();
    std::string names;
    for (const auto& [name, choice_value] : choices) {
      if (read == name) {
        value = choice_value;
        return;
      }
      names += fmt::format("{}\"{}\"", names.empty() ? "" : " or ", name);
    }
    fail(key, "must be " + names);
  }

  // An array of `count` numbers.
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count, double least,
                                            double greatest) const {
    return numbers(key, node(key), count, count, least, greatest);
  }

  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t least_count,
                                            std::size_t greatest_count, double least, double greatest) const {
    return numbers(key, node(key), least_count, greatest_count, least, greatest);
  }

  // An array of arrays of two numbers.
  [[nodiscard]] std::vector<std::vector<double>> pairs(const std::string& key, std::size_t least_count,
                                                       std::size_t greatest_count, double least,
                                                       double greatest) const {
    const toml::array* rows = node(key).as_array();
    if (rows == nullptr || rows->size() < least_count || rows->size() > greatest_count) {
      fail(key, fmt::format("must be a list of {} to {} pairs of numbers", least_count, greatest_count));
    }
    std::vector<std::vector<double>> result;
    for (const toml::node& row : *rows) {
      result.push_back(numbers(key, toml::node_view<const toml::node>(row), 2, 2, least, greatest));
    }
    return result;
  }

  [[nodiscard]] toml::node_view<const toml::node> node(const std::string& key) const {
    return root_.at_path(key);
  }

  [[noreturn]] void fail(const std::string& key, const std::string& rule) const {
    throw std::runtime_error(fmt::format("{}: {} = {}: {}", file_, key, text_of(node(key)), rule));
  }

 private:
  using Node = toml::node_view<const toml::node>;

  // On one line, which a long list is not written on, and not longer than one reads.
  static std::string text_of(const Node& from) {
    std::ostringstream lines;
    lines << from;
    std::string text;
    for (const char letter : lines.str()) {
      const bool is_space = letter == ' ' || letter == '\n';
      if (!is_space || text.empty() || text.back() != ' ') {
        text += is_space ? ' ' : letter;
      }
    }
    constexpr std::size_t longest = 200;
    return shown(text, longest);
  }

  int whole(const std::string& key, const Node& from, int least, int greatest) const {
    const auto read = from.value_exact<std::int64_t>();
    if (!read || *read < least || *read > greatest) {
      fail(key, fmt::format("must be a whole number from {} to {}", least, greatest));
    }
    return static_cast<int>(*read);
  }

  double number(const std::string& key, const Node& from, double least, double greatest) const {
    const auto read = from.is_number() ? from.value<double>() : std::nullopt;
    if (!read || !(*read >= least && *read <= greatest)) {
      fail(key, fmt::format("must be a number from {} to {}", least, greatest));
    }
    return *read;
  }

  std::vector<double> numbers(const std::string& key, const Node& from, std::size_t least_count,
                              std::size_t greatest_count, double least, double greatest) const {
    const toml::array* array = from.as_array();
    if (array == nullptr || array->size() < least_count || array->size() > greatest_count) {
      const std::string count = least_count == greatest_count ? "" : fmt::format("{} to ", least_count);
      fail(key, fmt::format("must hold {}{} numbers from {} to {}", count, greatest_count, least, greatest));
    }
    std::vector<double> result;
    for (const toml::node& element : *array) {
      result.push_back(number(key, Node(element), least, greatest));
    }
    return result;
  }

  const toml::table& root_;
  std::string file_;
};

}  // namespace striker::training
