// SPDX-License-Identifier: Apache-2.0
#include "tests/images/console.hpp"

#include <array>
#include <cstring>

namespace striker::images::console {

namespace {

constexpr std::size_t longest_line = 1024;

}  // namespace

void print(std::int64_t number) {
  std::array<char, 24> digits{};
  std::size_t at = digits.size() - 1;
  auto rest = static_cast<std::uint64_t>(number < 0 ? -number : number);
  do {
    digits[--at] = static_cast<char>('0' + rest % 10);
    rest /= 10;
  } while (rest != 0);
  if (number < 0) {
    digits[--at] = '-';
  }
  print(digits.data() + at);
}

void print_line(const char* name, std::int64_t number) {
  print(name);
  print(" ");
  print(number);
  print("\n");
}

const char* word_argument(const char* name) {
  static std::array<char, longest_line> line{};
  if (line[0] == '\0') {
    read_command_line(std::span(line).first(line.size() - 2));
  }
  for (const char* word = line.data(); *word != '\0'; word += std::strlen(word) + 1) {
    if (std::strcmp(word, name) == 0) {
      return word + std::strlen(word) + 1;
    }
  }
  return nullptr;
}

std::uint32_t argument(const char* name, std::uint32_t otherwise) {
  const char* digit = word_argument(name);
  if (digit == nullptr) {
    return otherwise;
  }
  std::uint32_t number = 0;
  for (; *digit >= '0' && *digit <= '9'; ++digit) {
    number = number * 10 + static_cast<std::uint32_t>(*digit - '0');
  }
  return number;
}

}  // namespace striker::images::console
