// SPDX-License-Identifier: Apache-2.0
// DBC files, however they are laid out: every statement is read, or refused.
#include "sil/budget/dbc_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "sil/world/random.hpp"
#include "tests/budget/dbc_text.hpp"

namespace striker::sil {
namespace {

// Every statement of the format, each as its tokens. The messages carry their signals.
using Tokens = std::vector<std::string>;
const std::vector<Tokens> every_statement = {
    {"VERSION", "\"1.0 \\\"beta\\\"\""},
    {"BS_", ":", "500", ":", "1", ",", "2"},
    {"BU_", ":", "Motor", "Brake"},
    {"VAL_TABLE_", "Switch", "1", "\"on; BO_ 9 X: 8 Y\"", "0", "\"off\"", ";"},
    {"BO_",      "256",   "Speed", ":", "8",   "Motor",  //
     "SG_",      "a",     ":",     "0", "|",   "16",    "@", "1+", "(",    "0.1",   ",", "-40",
     ")",        "[",     "0",     "|", "1e3", "]",  //
     "\"km/h\"", "Brake",                            //
     "SG_",      "b",     "m0M",   ":", "16",  "|",     "8", "@",  "0",    "-",     "(", "1",
     ",",        "0",     ")",     "[", "0",   "|",     "0", "]",  "\"\"", "Brake", ",", "Motor"},
    {"BO_", "2364540158", "Torque", ":", "8", "Brake"},
    {"BO_", "768", "Event", ":", "2", "Vector__XXX"},
    {"BO_", "3221225472", "VECTOR__INDEPENDENT_SIG_MSG", ":", "0", "Vector__XXX"},
    {"BO_", "1073741824", "VECTOR__INDEPENDENT_SIG_MSG", ":", "0", "Vector__XXX"},
    {"BA_", "\"GenMsgCycleTime\"", "BO_", "3221225472", "1", ";"},
    {"BO_", "769", "Big", ":", "48", "Motor"},
    {"BO_TX_BU_", "256", ":", "Motor", ",", "Brake", ";"},
    {"EV_", "Key", ":", "0", "[", "0", "|", "1", "]", "\"\"", "0", "1", "DUMMY_NODE_VECTOR0", "Motor", ";"},
    {"ENVVAR_DATA_", "Key", ":", "10", ";"},
    {"EV_DATA_", "Key", ":", "10", ";"},
    {"SGTYPE_", "Kind", ":", "16", ";"},
    {"SGTYPE_VAL_", "Kind", "0", "\"none\"", ";"},
    {"BA_DEF_SGTYPE_", "\"Of\"", "INT", "0", "1", ";"},
    {"BA_SGTYPE_", "\"Of\"", "Kind", "1", ";"},
    {"SIG_TYPE_REF_", "256", "a", ":", "Kind", ";"},
    {"SIGTYPE_VALTYPE_", "Kind", ":", "1", ";"},
    {"CM_", "\"the file\"", ";"},
    {"CM_", "BO_", "256", "\"once\nBO_ 768 Old: 8 Motor\nBA_ \\\"GenMsgCycleTime\\\" BO_ 256 1;\n\"", ";"},
    {"CM_", "SG_", "256", "a", "\"// no comment\"", ";"},
    {"CM_", "BU_", "Motor", "\"\"", ";"},
    {"CM_", "EV_", "Key", "\"\"", ";"},
    {"FILTER", "1", ";"},
    {"CAT_DEF_", "1", "\"all\"", "2", ";"},
    {"CAT_", "1", "256", ";"},
    {"BA_DEF_", "\"BusType\"", "STRING", ";"},
    {"BA_DEF_", "BO_", "\"GenMsgCycleTime\"", "INT", "0", "65535", ";"},
    {"BA_DEF_", "BO_", "\"GenMsgSendType\"", "ENUM", "\"Cyclic\"", ",", "\"OnEvent\"", ";"},
    {"BA_DEF_", "BO_", "\"VFrameFormat\"", "ENUM", "\"StandardCAN\"", ",", "\"ExtendedCAN\"", ";"},
    {"BA_DEF_", "SG_", "\"Deadline\"", "FLOAT", "0", "1E+3", ";"},
    {"BA_DEF_", "BU_", "\"Address\"", "HEX", "0", "255", ";"},
    {"BA_DEF_", "EV_", "\"Of\"", "INT", ";"},
    {"BA_DEF_REL_", "BU_SG_REL_", "\"Timeout\"", "INT", "0", "1000", ";"},
    {"BA_DEF_DEF_", "\"GenMsgCycleTime\"", "200", ";"},
    {"BA_DEF_DEF_", "\"GenMsgSendType\"", "\"Cyclic\"", ";"},
    {"BA_DEF_DEF_", "\"Deadline\"", "1", ";"},
    {"BA_DEF_DEF_REL_", "\"Timeout\"", "0", ";"},
    {"BA_", "\"BusType\"", "\"CAN FD\"", ";"},
    {"BA_", "\"GenMsgCycleTime\"", "BO_", "256", "1.5", ";"},
    {"BA_", "\"GenMsgSendType\"", "BO_", "768", "1", ";"},
    {"BA_", "\"GenMsgSendType\"", "BO_", "769", "\"Cyclic\"", ";"},
    {"BA_", "\"GenMsgDelayTime\"", "BO_", "768", "30", ";"},
    {"BA_", "\"GenSigStartValue\"", "SG_", "256", "a", "-1", ";"},
    {"BA_", "\"Address\"", "BU_", "Motor", "17", ";"},
    {"BA_", "\"Of\"", "EV_", "Key", "1", ";"},
    {"BA_REL_", "\"Timeout\"", "BU_SG_REL_", "Motor", "SG_", "256", "a", "100", ";"},
    {"BA_REL_", "\"Timeout\"", "BU_BO_REL_", "Motor", "256", "\"x\"", ";"},
    {"BA_REL_", "\"Timeout\"", "BU_EV_REL_", "Motor", "Key", "1", ";"},
    {"VAL_", "256", "a", "1", "\"on\"", "0", "\"off\"", ";"},
    {"VAL_", "Key", "1", "\"on\"", ";"},
    {"SIG_GROUP_", "256", "Both", "1", ":", "a", "b", ";"},
    {"SIG_VALTYPE_", "256", "a", ":", "1", ";"},
    {"SG_MUL_VAL_", "256", "b", "a", "0-0", ",", "3-5", ";"},
};

const DbcOptions with_data_bitrate = {.has_data_bitrate = true};

std::string plain(const std::vector<Tokens>& statements) {
  std::string text = "NS_ :\n\tCM_\n\tBA_DEF_\n\tFILTER\n\n";
  for (const Tokens& statement : statements) {
    for (const std::string& token : statement) {
      text += token + " ";
    }
    text += "\n";
  }
  return text;
}

TEST(DbcFile, EveryStatementIsRead) {
  const auto messages = read(plain(every_statement), with_data_bitrate);
  ASSERT_EQ(messages.size(), 4U);
  EXPECT_EQ(messages[0].name, "Speed");
  EXPECT_EQ(messages[0].sender, "Motor");
  EXPECT_EQ(messages[0].id, 256U);
  EXPECT_EQ(messages[0].bytes, 8);
  EXPECT_EQ(messages[0].period_ns, 1'500'000);
  EXPECT_EQ(messages[0].deadline_ns, 1'500'000);  // the Deadline of signals is none of messages
  EXPECT_EQ(messages[1].name, "Event");
  EXPECT_EQ(messages[1].period_ns, 30'000'000);
  EXPECT_EQ(messages[2].name, "Big");
  EXPECT_EQ(messages[2].format, (FrameFormat{.fd = true, .bit_rate_switch = true}));
  EXPECT_EQ(messages[3].name, "Torque");
  EXPECT_EQ(messages[3].id, 0x0CF004FEU);
  EXPECT_EQ(messages[3].format, FrameFormat{.extended = true});
  EXPECT_EQ(messages[3].period_ns, 200'000'000);
}

// Any order, any blanks, any line ends, and comments between tokens.
TEST(DbcFile, LayoutAndOrderDoNotMatter) {
  Random random(62, 0, 0);
  const auto expected = read(plain(every_statement), with_data_bitrate);
  const std::vector<std::string> gaps = {" ", "\t", "\n", "\r\n", "\r", "  \r\n ", " // BO_ 1 X: 8 Y\n"};
  const std::string marks = ":;,|@()[]";
  for (int file = 0; file < 2'000; ++file) {
    std::vector<Tokens> statements = every_statement;
    for (std::size_t i = statements.size() - 1; i > 0; --i) {
      std::swap(statements[i],
                statements[static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(i + 1)))]);
    }
    std::string text = random.below(4) == 0 ? "\xEF\xBB\xBF" : "";
    const bool one_line = random.below(3) == 0;
    for (const Tokens& statement : statements) {
      for (const std::string& token : statement) {
        const bool needs_none = marks.find(token) != std::string::npos && random.below(2) == 0;
        text += needs_none ? ""
                : one_line ? " "
                           : gaps[random.below(static_cast<std::uint32_t>(gaps.size()))];
        text += token;
      }
      text += one_line ? " " : gaps[random.below(static_cast<std::uint32_t>(gaps.size()))];
    }
    ASSERT_NO_FATAL_FAILURE(expect_same(expected, read(text, with_data_bitrate), text));
  }
}

TEST(DbcFile, AStatementWithoutItsEndIsRefused) {
  for (std::size_t i = 0; i < every_statement.size(); ++i) {
    std::vector<Tokens> statements = every_statement;
    if (statements[i].back() != ";") {
      continue;
    }
    statements[i].pop_back();
    EXPECT_NE(refusal(plain(statements), with_data_bitrate), "") << statements[i][0];
  }
}

TEST(DbcFile, WhatIsNoStatementIsRefusedWhereverItStands) {
  for (std::size_t i = 0; i <= every_statement.size(); ++i) {
    for (const Tokens& foreign : {Tokens{"FOO_", "1", "\"x\"", ";"}, Tokens{"FOO_", ":", "A"},
                                  Tokens{"BO", "5", "M", ":", "8", "A"}}) {
      std::vector<Tokens> statements = every_statement;
      statements.insert(statements.begin() + static_cast<std::ptrdiff_t>(i), foreign);
      EXPECT_NE(refusal(plain(statements), with_data_bitrate), "") << i << " " << foreign[0];
    }
  }
}

// Each token once left out: what is read then has all messages, but for a number more or less; mostly it is refused.
TEST(DbcFile, NoMessageIsLostWithATokenOfItsOwn) {
  std::size_t refused = 0;
  std::size_t all = 0;
  for (std::size_t i = 0; i < every_statement.size(); ++i) {
    for (std::size_t token = 0; token < every_statement[i].size(); ++token, ++all) {
      std::vector<Tokens> statements = every_statement;
      statements[i].erase(statements[i].begin() + static_cast<std::ptrdiff_t>(token));
      try {
        EXPECT_EQ(read(plain(statements), with_data_bitrate).size(), 4U) << i << " " << token;
      } catch (const std::runtime_error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused * 10, all * 7);
}

TEST(DbcFile, NamesAreBytes) {
  const auto messages =
      read("BO_ 1 \xD6\xC6\xB6\xAF: 8 \xE9\nBO_ 2 \xE5\x88\xB6: 8 A\n", {.default_distance_ms = 5});
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].name, "\xD6\xC6\xB6\xAF");
  EXPECT_EQ(messages[0].sender, "\xE9");
  EXPECT_EQ(messages[1].name, "\xE5\x88\xB6");
}

TEST(DbcFile, TheListOfSymbolsEndsWhereAStatementBegins) {
  const std::string rest = "BO_ 1 M: 8 A\n";
  const DbcOptions options{.default_distance_ms = 5};
  for (const char* list :
       {"NS_ :\n", "NS_ : CM_ BA_ BS_:\n", "NS_ :\n CM_\nBU_: A\n", "NS_ :\n CM_\n BA_DEF_\n",
        "NS_ :\n CM_\nCM_ \"x\";\n", "NS_ :\n FILTER\n VAL_\nVAL_TABLE_ T 0 \"x\";\n"}) {
    EXPECT_EQ(read(list + rest, options).size(), 1U) << list;
  }
  EXPECT_EQ(read("NS_ :\n\tCM_\n\tBA_\n" + rest + "CM_ BO_ 1 \"BO_ 2 N: 8 A\";\n", options).size(), 1U);
  EXPECT_EQ(refusal("NS_ :\n\tNEW_\nBS_:\n" + rest, options).rfind("line 2: 'NEW_'", 0), 0U);
}

TEST(DbcFile, SizesAreLimited) {
  std::string many = "BU_: A\n";
  for (std::size_t id = 0; id <= most_dbc_messages; ++id) {
    many += "BO_ " + std::to_string(2147483648U + id) + " M: 8 A\n";
  }
  EXPECT_NE(refusal(many, {.default_distance_ms = 10}).find("line 10002: more than 10000 messages"),
            std::string::npos);
  EXPECT_EQ(refusal("CM_ \"" + std::string(3'000'000, ' ') + "\";\nBO_ 1 M: 8 " + std::string(3'000'000, 'A'),
                    {.default_distance_ms = 10}),
            "");
  const std::string told = refusal("BO_ " + std::string(100'000, '9') + " M: 8 A\n");
  EXPECT_LT(told.size(), 200U) << told;
}

TEST(DbcFile, AFileThatCannotBeReadIsNamed) {
  for (const std::filesystem::path file : {"/nonexistent/a.dbc", "/tmp", "/dev/zero"}) {
    try {
      static_cast<void>(read_dbc(file, {}));
      FAIL() << file;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(file.string() + ": ", 0), 0U) << error.what();
      EXPECT_NE(std::string(error.what()).find("name a DBC file"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace striker::sil
