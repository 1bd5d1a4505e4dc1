// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/tcp/player_messages.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>

namespace striker::sil {

namespace {

constexpr std::size_t longest_message = 16'384;
constexpr std::size_t most_numbers = 64;

enum class Read { whole, unfinished, broken };

// Reads from the front of a text. Each step says whether it could; `unfinished` if more text may change that.
class Reader {
 public:
  explicit Reader(std::string_view text) : left_(text) {}

  Read message(PlayerMessage& message) {
    skip_blanks();
    if (const Read read = word("aiwc."); read != Read::whole) {
      return read;
    }
    const auto end = std::min(left_.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), left_.size());
    message.name = left_.substr(0, end);
    left_.remove_prefix(end);
    if (const Read read = word("("); read != Read::whole) {
      return read;
    }
    skip_blanks();
    if (word(")") == Read::whole) {
      return Read::whole;
    }
    return arguments(message.numbers);
  }

  [[nodiscard]] std::size_t left() const { return left_.size(); }

 private:
  Read arguments(std::vector<double>& numbers) {
    while (true) {
      skip_blanks();
      if (const Read read = argument(numbers); read != Read::whole) {
        return read;
      }
      skip_blanks();
      if (word(")") == Read::whole) {
        return Read::whole;
      }
      if (const Read read = word(","); read != Read::whole) {
        return read;
      }
    }
  }

  Read argument(std::vector<double>& numbers) {
    if (left_.empty()) {
      return Read::unfinished;
    }
    if (left_.front() == '"') {
      const auto end = left_.find('"', 1);
      if (end == std::string_view::npos) {
        return Read::unfinished;
      }
      left_.remove_prefix(end + 1);
      return Read::whole;
    }
    const auto end = left_.find_first_of(",) \t\r\n");
    const auto number = left_.substr(0, end);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (end == std::string_view::npos) {
      return Read::unfinished;
    }
    if (error != std::errc{} || stop != number.data() + number.size() || numbers.size() == most_numbers) {
      return Read::broken;
    }
    numbers.push_back(value);
    left_.remove_prefix(end);
    return Read::whole;
  }

  Read word(std::string_view expected) {
    const auto size = std::min(expected.size(), left_.size());
    if (left_.substr(0, size) != expected.substr(0, size)) {
      return Read::broken;
    }
    if (size < expected.size()) {
      return Read::unfinished;
    }
    left_.remove_prefix(size);
    return Read::whole;
  }

  void skip_blanks() { left_.remove_prefix(std::min(left_.find_first_not_of(" \t\r\n"), left_.size())); }

  std::string_view left_;
};

}  // namespace

void PlayerMessages::add(std::string_view text) {
  if (is_broken_) {
    return;
  }
  text_ += text;
}

std::optional<PlayerMessage> PlayerMessages::next() {
  if (is_broken_) {
    return std::nullopt;
  }
  Reader reader(text_);
  PlayerMessage message;
  const Read read = reader.message(message);
  const std::size_t size = text_.size() - reader.left();
  if (read == Read::whole && size <= longest_message) {
    text_.erase(0, size);
    return message;
  }
  if (read != Read::unfinished || text_.size() > longest_message) {
    is_broken_ = true;
    text_.clear();
  }
  return std::nullopt;
}

}  // namespace striker::sil
