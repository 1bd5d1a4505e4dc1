// SPDX-License-Identifier: Apache-2.0
#include "sil/budget/dbc_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace striker::sil {

namespace {

// What may stand under NS_.
constexpr std::array<std::string_view, 28> new_symbols = {"NS_DESC_",       "CM_",
                                                          "BA_DEF_",        "BA_",
                                                          "VAL_",           "CAT_DEF_",
                                                          "CAT_",           "FILTER",
                                                          "BA_DEF_DEF_",    "EV_DATA_",
                                                          "ENVVAR_DATA_",   "SGTYPE_",
                                                          "SGTYPE_VAL_",    "BA_SGTYPE_",
                                                          "BA_DEF_SGTYPE_", "SIG_TYPE_REF_",
                                                          "VAL_TABLE_",     "SIG_GROUP_",
                                                          "BO_TX_BU_",      "BA_DEF_REL_",
                                                          "SIG_VALTYPE_",   "SIGTYPE_VALTYPE_",
                                                          "BA_REL_",        "BA_DEF_DEF_REL_",
                                                          "BU_SG_REL_",     "BU_EV_REL_",
                                                          "BU_BO_REL_",     "SG_MUL_VAL_"};

constexpr std::array<std::string_view, 6> other_keywords = {"NS_", "BS_", "BU_", "BO_", "SG_", "EV_"};

template <std::size_t Count>
bool is_one_of(const std::array<std::string_view, Count>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

template <class Number>
Number number(const DbcCursor& cursor, const DbcToken& token, std::string_view what) {
  Number value{};
  const char* end = token.text.data() + token.text.size();
  const auto [stop, error] = std::from_chars(token.text.data(), end, value);
  if (error != std::errc() || stop != end) {
    cursor.fail(token.line, fmt::format("'{}' is no number in range: {} needs {}", shown(token.text),
                                        cursor.begun().text, what));
  }
  return value;
}

}  // namespace

bool is_dbc_keyword(const DbcToken& token) {
  return token.is_word() && token.text != "FILTER" &&
         (is_one_of(new_symbols, token.text) || is_one_of(other_keywords, token.text));
}

bool begins_with_digit(const DbcToken& token) {
  return token.is_word() && token.text.front() >= '0' && token.text.front() <= '9';
}

void DbcCursor::fail_here(std::string_view wanted) const {
  const DbcToken& found = current();
  const std::string place =
      found.kind == DbcToken::Kind::end ? "the file's end" : fmt::format("'{}'", shown(found.text));
  fail(found.line, fmt::format("{} where the {} of line {} needs {}: complete it, or remove it", place,
                               begun_.text, begun_.line, wanted));
}

bool DbcCursor::accept(char mark) {
  const bool is_there = current().is_mark(mark);
  if (is_there) {
    take();
  }
  return is_there;
}

bool DbcCursor::accept(std::string_view word) {
  const bool is_there = current().is_word(word);
  if (is_there) {
    take();
  }
  return is_there;
}

void DbcCursor::expect(char mark) {
  if (!accept(mark)) {
    fail_here(fmt::format("'{}'", mark));
  }
}

DbcToken DbcCursor::word(std::string_view what) {
  if (!current().is_word() || is_dbc_keyword(current())) {
    fail_here(what);
  }
  return take();
}

DbcToken DbcCursor::text(std::string_view what) {
  if (!current().is_text()) {
    fail_here(what);
  }
  return take();
}

std::uint32_t DbcCursor::identifier() {
  constexpr std::string_view what = "an identifier, as a decimal number";
  return number<std::uint32_t>(*this, word(what), what);
}

std::int64_t DbcCursor::whole_number(std::string_view what) {
  return number<std::int64_t>(*this, word(what), what);
}

// What follows tells a symbol of the list from the statement after it: another symbol, or the end of its line.
bool DbcCursor::is_symbol() const {
  const DbcToken& symbol = current();
  const DbcToken& next = following();
  return symbol.is_word() && is_one_of(new_symbols, symbol.text) &&
         (next.kind == DbcToken::Kind::end || next.line > symbol.line || next.is_word("BS_") ||
          (next.is_word() && is_one_of(new_symbols, next.text)));
}

void DbcCursor::symbols() {
  while (is_symbol()) {
    take();
  }
}

// Two keywords are names too: what follows tells.
bool DbcCursor::begins_statement() const {
  const DbcToken& token = current();
  return is_dbc_keyword(token) || (token.is_word("VERSION") && following().is_text()) ||
         (token.is_word("FILTER") && begins_with_digit(following()));
}

void DbcCursor::pair_in(char open, char between, char close) {
  expect(open);
  word("a number");
  expect(between);
  word("a number");
  expect(close);
}

// The first may be in a line of its own; another follows a comma, or in the same line: else it is a statement.
void DbcCursor::receivers() {
  bool may_follow = true;
  int line = 0;
  while (true) {
    const DbcToken& next = current();
    const bool is_name = next.is_word() && !begins_statement();
    if (!next.is_mark(',') && (!is_name || (!may_follow && next.line != line))) {
      return;
    }
    may_follow = !is_name;
    line = take().line;
  }
}

void DbcCursor::named_values() {
  while (!current().is_mark(';')) {
    word("a number");
    text("a text");
  }
  expect(';');
}

void DbcCursor::up_to_semicolon() {
  while (!current().is_mark(';')) {
    if (current().kind == DbcToken::Kind::end || begins_statement()) {
      fail_here("';'");
    }
    take();
  }
  expect(';');
}

}  // namespace striker::sil
