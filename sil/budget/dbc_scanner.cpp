// SPDX-License-Identifier: Apache-2.0
#include "sil/budget/dbc_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace striker::sil {

namespace {

constexpr std::string_view marks = ":;,|@()[]";
constexpr std::string_view blanks = " \t\v\f\r\n";
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool is_control(char byte) {
  return (byte >= '\0' && byte < ' ') || byte == '\x7F';
}

bool is_blank(char byte) {
  return blanks.find(byte) != std::string_view::npos;
}

bool ends_word(char byte) {
  return byte == '"' || is_control(byte) || is_blank(byte) || marks.find(byte) != std::string_view::npos;
}

}  // namespace

std::string shown(std::string_view text) {
  constexpr std::size_t most = 60;
  std::string out(text.substr(0, most));
  std::replace_if(out.begin(), out.end(), is_control, '?');
  return text.size() > most ? out + "..." : out;
}

void fail_dbc(const std::string& name, int line, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: line {}: {}", name, line, what));
}

DbcScanner::DbcScanner(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    fail_dbc(name_, 1, "UTF-16: save it as UTF-8 or in one byte a letter");
  }
  if (rest_.starts_with(byte_order_mark)) {
    rest_.remove_prefix(byte_order_mark.size());
  }
  current_ = scan();
  following_ = scan();
}

DbcToken DbcScanner::take() {
  DbcToken taken = std::exchange(current_, following_);
  following_ = scan();
  return taken;
}

// A CR before a LF belongs to it.
void DbcScanner::count_line_end() {
  const bool is_end = rest_[0] == '\n' || (rest_[0] == '\r' && !rest_.substr(1).starts_with('\n'));
  line_ += is_end ? 1 : 0;
}

void DbcScanner::skip_blanks() {
  while (!rest_.empty()) {
    if (rest_.starts_with("//")) {
      rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size()));
    } else if (is_blank(rest_[0])) {
      count_line_end();
      rest_.remove_prefix(1);
    } else {
      return;
    }
  }
}

DbcToken DbcScanner::scan_text() {
  const int first_line = line_;
  const std::string_view whole = rest_.substr(1);
  rest_.remove_prefix(1);
  while (!rest_.empty() && rest_[0] != '"') {
    count_line_end();
    rest_.remove_prefix(rest_.starts_with("\\\"") ? 2 : 1);
  }
  if (rest_.empty()) {
    fail_dbc(name_, first_line, "a text begins here that has no end: close it with a quote (\\\" is none)");
  }
  const std::string_view inside = whole.substr(0, whole.size() - rest_.size());
  rest_.remove_prefix(1);
  return {DbcToken::Kind::text, inside, first_line};
}

DbcToken DbcScanner::scan() {
  skip_blanks();
  if (rest_.empty()) {
    return {DbcToken::Kind::end, {}, line_};
  }
  if (rest_[0] == '"') {
    return scan_text();
  }
  const bool is_mark = marks.find(rest_[0]) != std::string_view::npos;
  const auto word_end =
      static_cast<std::size_t>(std::find_if(rest_.begin(), rest_.end(), ends_word) - rest_.begin());
  const std::size_t size = is_mark ? 1 : std::min(word_end, rest_.find("//"));
  if (size == 0) {
    const unsigned byte = static_cast<unsigned char>(rest_[0]);
    fail_dbc(name_, line_, fmt::format("byte 0x{:02X} outside a text: name a DBC file, or remove it", byte));
  }
  const std::string_view token = rest_.substr(0, size);
  rest_.remove_prefix(token.size());
  return {is_mark ? DbcToken::Kind::mark : DbcToken::Kind::word, token, line_};
}

}  // namespace striker::sil
