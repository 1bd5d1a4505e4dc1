// SPDX-License-Identifier: Apache-2.0
#include "sil/budget/dbc_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <utility>

#include "sil/budget/dbc_scanner.hpp"

namespace striker::sil {

namespace {

// Vector's home for signals that are in no message; bit 31 is missing in some files.
constexpr std::uint32_t no_message = 0x40000000;
constexpr std::string_view no_message_name = "VECTOR__INDEPENDENT_SIG_MSG";
constexpr std::string_view no_node = "Vector__XXX";

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

// A node, a signal or a message may be called FILTER or VERSION, but not BO_.
bool is_keyword(const DbcToken& token) {
  return token.is_word() && token.text != "FILTER" &&
         (is_one_of(new_symbols, token.text) || is_one_of(other_keywords, token.text));
}

bool begins_with_digit(const DbcToken& token) {
  return token.is_word() && token.text.front() >= '0' && token.text.front() <= '9';
}

class DbcParser {
 public:
  DbcParser(std::string_view text, const std::string& name) : tokens_(text, name) { file_.name = name; }

  DbcFile parse() && {
    while (tokens_.current().kind != DbcToken::Kind::end) {
      statement();
    }
    if (file_.messages.empty()) {
      throw std::runtime_error(
          fmt::format("{}: no message (BO_) in it: name a DBC file that has one", file_.name));
    }
    return std::move(file_);
  }

 private:
  using Read = void (DbcParser::*)();
  struct Statement {
    std::string_view keyword;
    Read read;
  };
  static const std::array<Statement, 31> statements;

  [[noreturn]] void fail(int line, const std::string& what) const { fail_dbc(file_.name, line, what); }

  [[noreturn]] void fail_here(std::string_view wanted) const {
    const DbcToken& found = tokens_.current();
    const std::string place =
        found.kind == DbcToken::Kind::end ? "the file's end" : fmt::format("'{}'", shown(found.text));
    fail(found.line, fmt::format("{} where the {} of line {} needs {}: complete it, or remove it", place,
                                 begun_.text, begun_.line, wanted));
  }

  // ---- parts of statements -----------------------------------------------------------------------------

  bool accept(char mark) {
    const bool is_there = tokens_.current().is_mark(mark);
    if (is_there) {
      tokens_.take();
    }
    return is_there;
  }
  bool accept(std::string_view word) {
    const bool is_there = tokens_.current().is_word(word);
    if (is_there) {
      tokens_.take();
    }
    return is_there;
  }
  void expect(char mark) {
    if (!accept(mark)) {
      fail_here(fmt::format("'{}'", mark));
    }
  }
  DbcToken word(std::string_view what) {
    if (!tokens_.current().is_word() || is_keyword(tokens_.current())) {
      fail_here(what);
    }
    return tokens_.take();
  }
  DbcToken text(std::string_view what) {
    if (!tokens_.current().is_text()) {
      fail_here(what);
    }
    return tokens_.take();
  }
  DbcValue value() {
    const DbcToken token = tokens_.current().is_text() ? tokens_.take() : word("a value");
    return {std::string(token.text), token.is_text(), token.line};
  }
  template <class Number>
  Number number(std::string_view what) {
    const DbcToken token = word(what);
    Number value{};
    const char* end = token.text.data() + token.text.size();
    const auto [stop, error] = std::from_chars(token.text.data(), end, value);
    if (error != std::errc() || stop != end) {
      fail(token.line,
           fmt::format("'{}' is no number in range: {} needs {}", shown(token.text), begun_.text, what));
    }
    return value;
  }
  std::uint32_t identifier() { return number<std::uint32_t>("an identifier, as a decimal number"); }

  // ---- statements --------------------------------------------------------------------------------------

  void statement() {
    begun_ = tokens_.take();
    for (const Statement& known : statements) {
      if (begun_.is_word(known.keyword)) {
        (this->*known.read)();
        return;
      }
    }
    fail(begun_.line, fmt::format("'{}' begins no DBC statement: remove it, or mend the statement before it",
                                  shown(begun_.text)));
  }

  void version() {
    text("a text");
    accept(';');
  }

  // What follows tells a symbol of the list from the statement after it: another symbol, or the end of its line.
  [[nodiscard]] bool is_new_symbol() const {
    const DbcToken& symbol = tokens_.current();
    const DbcToken& next = tokens_.following();
    return symbol.is_word() && is_one_of(new_symbols, symbol.text) &&
           (next.kind == DbcToken::Kind::end || next.line > symbol.line || next.is_word("BS_") ||
            (next.is_word() && is_one_of(new_symbols, next.text)));
  }

  void new_symbol_list() {
    expect(':');
    while (is_new_symbol()) {
      tokens_.take();
    }
  }

  // The bit rate and its two registers, long out of use.
  void bit_timing() {
    expect(':');
    if (begins_with_digit(tokens_.current())) {
      tokens_.take();
      if (accept(':')) {
        word("a register");
        expect(',');
        word("a register");
      }
    }
    accept(';');
  }

  // Two keywords are names too: what follows tells.
  [[nodiscard]] bool begins_statement() const {
    const DbcToken& token = tokens_.current();
    return is_keyword(token) || (token.is_word("VERSION") && tokens_.following().is_text()) ||
           (token.is_word("FILTER") && begins_with_digit(tokens_.following()));
  }

  void nodes() {
    expect(':');
    while (tokens_.current().is_word() && !begins_statement()) {
      if (begins_with_digit(tokens_.current())) {
        fail_here("a node's name");
      }
      tokens_.take();
    }
  }

  void message() {
    const std::uint32_t id = identifier();
    const DbcToken name = word("a name");
    expect(':');
    const auto bytes = number<std::int64_t>("a number of bytes");
    if (!tokens_.current().is_word() || is_keyword(tokens_.current())) {
      fail(begun_.line, fmt::format("message {} has no sender: write its node after the length, or {}",
                                    shown(name.text), no_node));
    }
    const DbcToken sender = word("a sender");
    has_message_ = true;
    if ((id & ~extended_identifier_bit) == no_message && name.text == no_message_name) {
      return;
    }
    const DbcMessage message{std::string(name.text), std::string(sender.text), bytes, begun_.line};
    if (const auto [there, is_new] = file_.messages.try_emplace(id, message); !is_new) {
      fail(begun_.line,
           fmt::format("identifier {} is there twice, first in line {}: give each message its own", id,
                       there->second.line));
    }
    if (file_.messages.size() > most_dbc_messages) {
      fail(begun_.line, fmt::format("more than {} messages: split the file", most_dbc_messages));
    }
  }

  void signal() {
    if (!has_message_) {
      fail(begun_.line, "a signal (SG_) before every message: move it under its BO_");
    }
    word("a name");
    if (tokens_.current().is_word()) {
      word("a multiplexer");
    }
    expect(':');
    word("a first bit");
    expect('|');
    word("a length");
    expect('@');
    word("a byte order");
    if (!tokens_.current().is_mark('(')) {
      word("a sign");
    }
    pair_in('(', ',', ')');
    pair_in('[', '|', ']');
    text("a unit");
    receivers();
  }

  void pair_in(char open, char between, char close) {
    expect(open);
    word("a number");
    expect(between);
    word("a number");
    expect(close);
  }

  // The first may be in a line of its own; another follows a comma, or in the same line: else it is a statement.
  void receivers() {
    bool may_follow = true;
    int line = 0;
    while (true) {
      const DbcToken& next = tokens_.current();
      const bool is_name = next.is_word() && !begins_statement();
      if (!next.is_mark(',') && (!is_name || (!may_follow && next.line != line))) {
        return;
      }
      may_follow = !is_name;
      line = tokens_.take().line;
    }
  }

  // What a comment or a value is about; nothing: the file. The identifier, if it is a message.
  std::optional<std::uint32_t> object() {
    if (accept("BO_")) {
      return identifier();
    }
    if (accept("SG_")) {
      identifier();
      word("a signal");
    } else if (accept("BU_") || accept("EV_")) {
      word("a name");
    }
    return std::nullopt;
  }

  void comment() {
    object();
    text("a text");
    expect(';');
  }

  DbcDefinition type() {
    const DbcToken name = word("INT, HEX, FLOAT, STRING or ENUM");
    DbcDefinition definition;
    if (name.text == "ENUM") {
      definition.type = DbcDefinition::Type::choice;
      while (tokens_.current().is_text()) {
        definition.choices.emplace_back(tokens_.take().text);
        accept(',');
      }
    } else if (name.text == "STRING") {
      definition.type = DbcDefinition::Type::text;
    } else if (name.text == "INT" || name.text == "HEX" || name.text == "FLOAT") {
      definition.type = name.text == "INT"   ? DbcDefinition::Type::whole
                        : name.text == "HEX" ? DbcDefinition::Type::hex
                                             : DbcDefinition::Type::real;
      if (!tokens_.current().is_mark(';')) {
        word("a smallest value");
        word("a greatest value");
      }
    } else {
      fail(name.line, fmt::format("'{}' is no type of an attribute: write INT, HEX, FLOAT, STRING or ENUM",
                                  shown(name.text)));
    }
    expect(';');
    return definition;
  }

  void definition() {
    const bool of_messages = accept("BO_");
    if (!of_messages) {
      accept("SG_") || accept("BU_") || accept("EV_");
    }
    const std::string name(text("an attribute's name in quotes").text);
    DbcDefinition definition = type();
    if (!is_one_of(dbc_attribute::all, name)) {
      return;
    }
    if (!of_messages) {
      file_.defined_elsewhere.insert(name);
    } else if (!file_.definitions.try_emplace(name, std::move(definition)).second) {
      fail(begun_.line, fmt::format("attribute {} of messages is defined twice: remove one", name));
    }
  }

  void relation_definition() {
    accept("BU_SG_REL_") || accept("BU_BO_REL_") || accept("BU_EV_REL_");
    text("an attribute's name in quotes");
    type();
  }

  void take_value(DbcFile::Values& values, const std::string& name, const DbcValue& value) const {
    const auto [there, is_new] = values.try_emplace(name, value);
    if (!is_new && there->second.text != value.text) {
      fail(value.line,
           fmt::format("{} is given again, otherwise than in line {}: remove one", name, there->second.line));
    }
  }

  void default_value() {
    const std::string name(text("an attribute's name in quotes").text);
    const DbcValue given = value();
    expect(';');
    if (is_one_of(dbc_attribute::all, name)) {
      take_value(file_.defaults, name, given);
    }
  }

  void relation_default() {
    text("an attribute's name in quotes");
    value();
    expect(';');
  }

  void attribute_value() {
    const std::string name(text("an attribute's name in quotes").text);
    const auto id = object();
    const DbcValue given = value();
    expect(';');
    if (id && (*id & ~extended_identifier_bit) != no_message && is_one_of(dbc_attribute::all, name)) {
      take_value(file_.values[*id], name, given);
    }
  }

  void relation_value() {
    text("an attribute's name in quotes");
    if (accept("BU_SG_REL_")) {
      word("a node");
      accept("SG_");
      identifier();
      word("a signal");
    } else if (accept("BU_BO_REL_") || accept("BU_EV_REL_")) {
      word("a node");
      word("an identifier or a name");
    } else {
      fail_here("BU_SG_REL_, BU_BO_REL_ or BU_EV_REL_");
    }
    value();
    expect(';');
  }

  void named_values() {
    while (!tokens_.current().is_mark(';')) {
      word("a number");
      text("a text");
    }
    expect(';');
  }

  void value_table() {
    word("a name");
    named_values();
  }

  // Of a signal (identifier and name) or of an environment variable (name).
  void value_names() {
    word("an identifier or a name");
    if (!tokens_.following().is_text() && !tokens_.current().is_mark(';')) {
      word("a signal");
    }
    named_values();
  }

  void up_to_semicolon() {
    while (!tokens_.current().is_mark(';')) {
      if (tokens_.current().kind == DbcToken::Kind::end || begins_statement()) {
        fail_here("';'");
      }
      tokens_.take();
    }
    expect(';');
  }

  DbcScanner tokens_;
  DbcFile file_;
  DbcToken begun_;  // the keyword of the statement that is read
  bool has_message_ = false;
};

const std::array<DbcParser::Statement, 31> DbcParser::statements = {{
    {"VERSION", &DbcParser::version},
    {"NS_", &DbcParser::new_symbol_list},
    {"BS_", &DbcParser::bit_timing},
    {"BU_", &DbcParser::nodes},
    {"BO_", &DbcParser::message},
    {"SG_", &DbcParser::signal},
    {"CM_", &DbcParser::comment},
    {"BA_DEF_", &DbcParser::definition},
    {"BA_DEF_DEF_", &DbcParser::default_value},
    {"BA_", &DbcParser::attribute_value},
    {"BA_DEF_REL_", &DbcParser::relation_definition},
    {"BA_DEF_DEF_REL_", &DbcParser::relation_default},
    {"BA_REL_", &DbcParser::relation_value},
    {"BA_DEF_SGTYPE_", &DbcParser::relation_definition},
    {"BA_SGTYPE_", &DbcParser::up_to_semicolon},
    {"VAL_", &DbcParser::value_names},
    {"VAL_TABLE_", &DbcParser::value_table},
    {"SGTYPE_VAL_", &DbcParser::value_table},
    {"BO_TX_BU_", &DbcParser::up_to_semicolon},
    {"SIG_GROUP_", &DbcParser::up_to_semicolon},
    {"SIG_VALTYPE_", &DbcParser::up_to_semicolon},
    {"SIGTYPE_VALTYPE_", &DbcParser::up_to_semicolon},
    {"SIG_TYPE_REF_", &DbcParser::up_to_semicolon},
    {"SG_MUL_VAL_", &DbcParser::up_to_semicolon},
    {"SGTYPE_", &DbcParser::up_to_semicolon},
    {"EV_", &DbcParser::up_to_semicolon},
    {"EV_DATA_", &DbcParser::up_to_semicolon},
    {"ENVVAR_DATA_", &DbcParser::up_to_semicolon},
    {"CAT_DEF_", &DbcParser::up_to_semicolon},
    {"CAT_", &DbcParser::up_to_semicolon},
    {"FILTER", &DbcParser::up_to_semicolon},
}};

}  // namespace

DbcFile parse_dbc(std::string_view text, const std::string& name) {
  return DbcParser(text, name).parse();
}

}  // namespace striker::sil
