// SPDX-License-Identifier: Apache-2.0
// The parts that DBC statements are made of, for a reader that goes through a file statement by statement. What is not
// there ends in an error with the line (fail_dbc), what is there and what the statement needs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sil/budget/dbc_scanner.hpp"

namespace striker::sil {

// With which a statement begins, or which stands in one before a name: no name itself. FILTER and VERSION are not
// among them, because nodes, signals and messages may be called so.
[[nodiscard]] bool is_dbc_keyword(const DbcToken& token);

[[nodiscard]] bool begins_with_digit(const DbcToken& token);

class DbcCursor {
 public:
  DbcCursor(std::string_view text, const std::string& name) : tokens_(text, name) {}

  [[nodiscard]] const DbcToken& current() const { return tokens_.current(); }
  [[nodiscard]] const DbcToken& following() const { return tokens_.following(); }
  DbcToken take() { return tokens_.take(); }

  // A statement: the current token is its keyword, which is taken and named in errors.
  void begin() { begun_ = take(); }
  [[nodiscard]] const DbcToken& begun() const { return begun_; }

  [[noreturn]] void fail(int line, const std::string& what) const { fail_dbc(tokens_.name(), line, what); }
  [[noreturn]] void fail_here(std::string_view wanted) const;

  // Takes it if it is there.
  bool accept(char mark);
  bool accept(std::string_view word);

  // Each takes what has to be there; `what` says so in the error. A word is no keyword.
  void expect(char mark);
  DbcToken word(std::string_view what);
  DbcToken text(std::string_view what);
  std::uint32_t identifier();
  std::int64_t whole_number(std::string_view what);

  void pair_in(char open, char between, char close);  // two words, as in (1,0)
  void named_values();                                // numbers and texts, up to the semicolon
  void symbols();                                     // the list under NS_
  void receivers();                                   // of a signal: none, or names up to the next statement
  void up_to_semicolon();                             // anything but the next statement

  // Whether the current token is a statement's keyword where a name may be too.
  [[nodiscard]] bool begins_statement() const;

 private:
  [[nodiscard]] bool is_symbol() const;

  DbcScanner tokens_;
  DbcToken begun_;
};

}  // namespace striker::sil
