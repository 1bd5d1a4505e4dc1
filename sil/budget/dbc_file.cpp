// SPDX-License-Identifier: Apache-2.0
#include "sil/budget/dbc_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "sil/budget/dbc_cursor.hpp"

namespace striker::sil {

namespace {

// Vector's home for signals that are in no message; bit 31 is missing in some files.
constexpr std::uint32_t no_message = 0x40000000;
constexpr std::string_view no_message_name = "VECTOR__INDEPENDENT_SIG_MSG";
constexpr std::string_view no_node = "Vector__XXX";

bool is_read(std::string_view attribute) {
  return std::find(dbc_attribute::all.begin(), dbc_attribute::all.end(), attribute) !=
         dbc_attribute::all.end();
}

class DbcParser : private DbcCursor {
 public:
  DbcParser(std::string_view text, const std::string& name) : DbcCursor(text, name) { file_.name = name; }

  DbcFile parse() && {
    while (current().kind != DbcToken::Kind::end) {
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

  DbcValue value() {
    const DbcToken token = current().is_text() ? take() : word("a value");
    return {std::string(token.text), token.is_text(), token.line};
  }
  void statement() {
    begin();
    for (const Statement& known : statements) {
      if (begun().is_word(known.keyword)) {
        (this->*known.read)();
        return;
      }
    }
    fail(begun().line, fmt::format("'{}' begins no DBC statement: remove it, or mend the statement before it",
                                   shown(begun().text)));
  }

  void version() {
    text("a text");
    accept(';');
  }

  void symbol_list() {
    expect(':');
    symbols();
  }

  // The bit rate and its two registers, long out of use.
  void bit_timing() {
    expect(':');
    if (begins_with_digit(current())) {
      take();
      if (accept(':')) {
        word("a register");
        expect(',');
        word("a register");
      }
    }
    accept(';');
  }

  void nodes() {
    expect(':');
    while (current().is_word() && !begins_statement()) {
      if (begins_with_digit(current())) {
        fail_here("a node's name");
      }
      take();
    }
  }

  void message() {
    const std::uint32_t id = identifier();
    const DbcToken name = word("a name");
    expect(':');
    const auto bytes = whole_number("a number of bytes");
    if (!current().is_word() || is_dbc_keyword(current())) {
      fail(begun().line, fmt::format("message {} has no sender: write its node after the length, or {}",
                                     shown(name.text), no_node));
    }
    const DbcToken sender = word("a sender");
    has_message_ = true;
    if ((id & ~extended_identifier_bit) == no_message && name.text == no_message_name) {
      return;
    }
    const DbcMessage message{std::string(name.text), std::string(sender.text), bytes, begun().line};
    if (const auto [there, is_new] = file_.messages.try_emplace(id, message); !is_new) {
      fail(begun().line,
           fmt::format("identifier {} is there twice, first in line {}: give each message its own", id,
                       there->second.line));
    }
    if (file_.messages.size() > most_dbc_messages) {
      fail(begun().line, fmt::format("more than {} messages: split the file", most_dbc_messages));
    }
  }

  void signal() {
    if (!has_message_) {
      fail(begun().line, "a signal (SG_) before every message: move it under its BO_");
    }
    word("a name");
    if (current().is_word()) {
      word("a multiplexer");
    }
    expect(':');
    word("a first bit");
    expect('|');
    word("a length");
    expect('@');
    word("a byte order");
    if (!current().is_mark('(')) {
      word("a sign");
    }
    pair_in('(', ',', ')');
    pair_in('[', '|', ']');
    text("a unit");
    receivers();
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
      while (current().is_text()) {
        definition.choices.emplace_back(take().text);
        accept(',');
      }
    } else if (name.text == "STRING") {
      definition.type = DbcDefinition::Type::text;
    } else if (name.text == "INT" || name.text == "HEX" || name.text == "FLOAT") {
      definition.type = name.text == "INT"   ? DbcDefinition::Type::whole
                        : name.text == "HEX" ? DbcDefinition::Type::hex
                                             : DbcDefinition::Type::real;
      if (!current().is_mark(';')) {
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
    if (!is_read(name)) {
      return;
    }
    if (!of_messages) {
      file_.defined_elsewhere.insert(name);
    } else if (!file_.definitions.try_emplace(name, std::move(definition)).second) {
      fail(begun().line, fmt::format("attribute {} of messages is defined twice: remove one", name));
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
    if (is_read(name)) {
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
    if (id && (*id & ~extended_identifier_bit) != no_message && is_read(name)) {
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

  void rest() { up_to_semicolon(); }

  void value_table() {
    word("a name");
    named_values();
  }

  // Of a signal (identifier and name) or of an environment variable (name).
  void value_names() {
    word("an identifier or a name");
    if (!following().is_text() && !current().is_mark(';')) {
      word("a signal");
    }
    named_values();
  }

  DbcFile file_;
  bool has_message_ = false;
};

const std::array<DbcParser::Statement, 31> DbcParser::statements = {{
    {"VERSION", &DbcParser::version},
    {"NS_", &DbcParser::symbol_list},
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
    {"BA_SGTYPE_", &DbcParser::rest},
    {"VAL_", &DbcParser::value_names},
    {"VAL_TABLE_", &DbcParser::value_table},
    {"SGTYPE_VAL_", &DbcParser::value_table},
    {"BO_TX_BU_", &DbcParser::rest},
    {"SIG_GROUP_", &DbcParser::rest},
    {"SIG_VALTYPE_", &DbcParser::rest},
    {"SIGTYPE_VALTYPE_", &DbcParser::rest},
    {"SIG_TYPE_REF_", &DbcParser::rest},
    {"SG_MUL_VAL_", &DbcParser::rest},
    {"SGTYPE_", &DbcParser::rest},
    {"EV_", &DbcParser::rest},
    {"EV_DATA_", &DbcParser::rest},
    {"ENVVAR_DATA_", &DbcParser::rest},
    {"CAT_DEF_", &DbcParser::rest},
    {"CAT_", &DbcParser::rest},
    {"FILTER", &DbcParser::rest},
}};

}  // namespace

DbcFile parse_dbc(std::string_view text, const std::string& name) {
  return DbcParser(text, name).parse();
}

}  // namespace striker::sil
