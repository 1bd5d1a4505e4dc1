// SPDX-License-Identifier: Apache-2.0
// A DBC file's words, texts and marks, one after the other, with the line of each.
//
//   text   between two quotes, over any number of lines; \" is a quote in it, as canmatrix and cantools write it
//   mark   one of : ; , | @ ( ) [ ]
//   word   everything else between blanks, texts and marks, bytes beyond ASCII included
//   //     up to the end of its line is left out, but not in a text
//
// Lines end with LF, CR LF or CR; a UTF-8 byte order mark is left out. The cost is one pass over the text, and no
// memory.
#pragma once

#include <string>
#include <string_view>

namespace striker::sil {

struct DbcToken {
  enum class Kind { word, text, mark, end };
  Kind kind = Kind::end;
  std::string_view text;  // of a text what is between its quotes, as it is written
  int line = 1;           // where it begins, from 1

  [[nodiscard]] bool is_word() const { return kind == Kind::word; }
  [[nodiscard]] bool is_word(std::string_view word) const { return is_word() && text == word; }
  [[nodiscard]] bool is_text() const { return kind == Kind::text; }
  [[nodiscard]] bool is_mark(char mark) const { return kind == Kind::mark && text.front() == mark; }
};

// Of an input, for an error message: at most 60 bytes, no control characters.
[[nodiscard]] std::string shown(std::string_view text);

// Throws std::runtime_error "NAME: line N: what is wrong: the way out".
[[noreturn]] void fail_dbc(const std::string& name, int line, const std::string& what);

class DbcScanner {
 public:
  // `text` outlives the scanner and its tokens; `name` is the file's, for errors. Throws as fail_dbc does, here and
  // in take(): at a text without an end, at a byte that no text file has, at UTF-16.
  DbcScanner(std::string_view text, std::string name);

  [[nodiscard]] const DbcToken& current() const { return current_; }
  [[nodiscard]] const DbcToken& following() const { return following_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  // The current token; the following one becomes current.
  DbcToken take();

 private:
  DbcToken scan();
  DbcToken scan_text();
  void skip_blanks();
  void count_line_end();

  std::string_view rest_;
  std::string name_;
  int line_ = 1;
  DbcToken current_;
  DbcToken following_;
};

}  // namespace striker::sil
