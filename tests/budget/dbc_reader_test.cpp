// SPDX-License-Identifier: Apache-2.0
// DBC files, however they are laid out: read whole, or refused with the line that is wrong and a way out.
#include "sil/budget/dbc_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "sil/budget/dbc_file.hpp"
#include "sil/world/random.hpp"

namespace striker::sil {
namespace {

std::vector<BusMessage> read(const std::string& text, const DbcOptions& options = {}) {
  return read_dbc(text, "a.dbc", options);
}

// Without the file's name.
std::string refusal(const std::string& text, const DbcOptions& options = {}) {
  try {
    EXPECT_FALSE(read(text, options).empty());
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind("a.dbc: ", 0), 0U) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what.substr(7);
  }
  return "";
}

auto parts(const BusMessage& message) {
  return std::tie(message.name, message.sender, message.id, message.bytes, message.period_ns,
                  message.distance_ns, message.burst, message.deadline_ns, message.format.extended,
                  message.format.fd, message.format.bit_rate_switch, message.events_uncounted);
}

void expect_same(const std::vector<BusMessage>& one, const std::vector<BusMessage>& other,
                 const std::string& text) {
  ASSERT_EQ(one.size(), other.size()) << text;
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(parts(one[i]), parts(other[i])) << text;
  }
}

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

TEST(DbcReader, EveryStatementIsRead) {
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
TEST(DbcReader, LayoutAndOrderDoNotMatter) {
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

TEST(DbcReader, AStatementWithoutItsEndIsRefused) {
  for (std::size_t i = 0; i < every_statement.size(); ++i) {
    std::vector<Tokens> statements = every_statement;
    if (statements[i].back() != ";") {
      continue;
    }
    statements[i].pop_back();
    EXPECT_NE(refusal(plain(statements), with_data_bitrate), "") << statements[i][0];
  }
}

TEST(DbcReader, WhatIsNoStatementIsRefusedWhereverItStands) {
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
TEST(DbcReader, NoMessageIsLostWithATokenOfItsOwn) {
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

TEST(DbcReader, NamesAreBytes) {
  const auto messages =
      read("BO_ 1 \xD6\xC6\xB6\xAF: 8 \xE9\nBO_ 2 \xE5\x88\xB6: 8 A\n", {.default_distance_ms = 5});
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].name, "\xD6\xC6\xB6\xAF");
  EXPECT_EQ(messages[0].sender, "\xE9");
  EXPECT_EQ(messages[1].name, "\xE5\x88\xB6");
}

TEST(DbcReader, TheListOfSymbolsEndsWhereAStatementBegins) {
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

// ---- what attributes mean ----------------------------------------------------------------------------------

const std::string two_types =
    "BO_ 1 M: 8 A\n"
    "BA_DEF_ BO_ \"GenMsgSendType\" ENUM \"Cyclic\",\"OnEvent\",\"NoMsgSendType\",\"CyclicAndSpontan\",\"Acyclic\";\n"
    "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;\n"
    "BA_DEF_DEF_ \"GenMsgCycleTime\" 200;\n";

std::string own(const std::string& attribute, const std::string& value) {
  std::string text = "BA_ \"";
  for (const std::string& part : {attribute, std::string("\" BO_ 1 "), value, std::string(";\n")}) {
    text += part;
  }
  return text;
}

TEST(DbcReader, TheDefaultCycleTimeIsForMessagesWithACycle) {
  EXPECT_EQ(read(two_types)[0].period_ns, 200'000'000);
  for (const std::string cyclic : {"0", "3", "\"Cyclic\""}) {
    EXPECT_EQ(read(two_types + own("GenMsgSendType", cyclic))[0].period_ns, 200'000'000) << cyclic;
  }
  for (const std::string other : {"1", "2", "4", "\"OnEvent\""}) {
    const std::string text = two_types + own("GenMsgSendType", other);
    EXPECT_NE(refusal(text).find("line 1: message M: GenMsgSendType"), std::string::npos) << other;
    EXPECT_EQ(read(text, {.default_distance_ms = 7})[0].period_ns, 7'000'000);
    EXPECT_EQ(read(text + "BA_ \"GenMsgCycleTime\" BO_ 1 50;")[0].period_ns, 50'000'000);
    EXPECT_EQ(read(text + "BA_ \"GenMsgDelayTime\" BO_ 1 20;")[0].period_ns, 20'000'000);
  }
  EXPECT_NE(refusal(two_types + "BA_DEF_DEF_ \"GenMsgSendType\" \"OnEvent\";"), "");
  EXPECT_EQ(read(two_types + "BA_DEF_DEF_ \"GenMsgSendType\" \"\";")[0].period_ns, 200'000'000);
}

TEST(DbcReader, TheDefaultDelayTimeIsForMessagesWithEvents) {
  const std::string text = two_types + "BA_DEF_DEF_ \"GenMsgDelayTime\" 20;BA_ \"GenMsgSendType\" BO_ 1 ";
  EXPECT_EQ(read(two_types + "BA_DEF_DEF_ \"GenMsgDelayTime\" 20;")[0].distance_ns, 20'000'000);
  EXPECT_EQ(read(text + "1;")[0].distance_ns, 20'000'000);
  EXPECT_EQ(read(text + "3;")[0].distance_ns, 20'000'000);
  EXPECT_EQ(read(text + "0;")[0].distance_ns, 200'000'000);
  EXPECT_EQ(read(text + "0;BA_ \"GenMsgDelayTime\" BO_ 1 30;")[0].distance_ns, 30'000'000);
  EXPECT_NE(refusal(text + "2;"), "");
}

TEST(DbcReader, EventsThatNothingBoundsAreToldOf) {
  const std::string both = two_types + "BA_ \"GenMsgSendType\" BO_ 1 3;";
  EXPECT_TRUE(read(both)[0].events_uncounted);
  EXPECT_FALSE(read(two_types)[0].events_uncounted);
  EXPECT_FALSE(read(both + "BA_ \"GenMsgDelayTime\" BO_ 1 20;")[0].events_uncounted);
  EXPECT_FALSE(read(both + "BA_ \"Burst\" BO_ 1 2;")[0].events_uncounted);
}

TEST(DbcReader, ValuesAreOfTheirType) {
  const std::string message = "BO_ 1 M: 8 A\nBA_ \"GenMsgCycleTime\" BO_ 1 ";
  const auto period_ns = [&](const std::string& rest) { return read(message + rest)[0].period_ns; };
  EXPECT_EQ(period_ns("10;"), 10'000'000);
  EXPECT_EQ(period_ns("+1.5E+001;BA_DEF_ BO_ \"GenMsgCycleTime\" FLOAT 0 100;"), 15'000'000);
  EXPECT_EQ(period_ns("0.15;BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 100;"), 150'000);
  EXPECT_EQ(period_ns("0x10;BA_DEF_ BO_ \"GenMsgCycleTime\" HEX 0 100;"), 16'000'000);
  EXPECT_EQ(period_ns("\"10\";BA_DEF_ BO_ \"GenMsgCycleTime\" STRING;"), 10'000'000);
  EXPECT_EQ(period_ns("1;BA_DEF_ BO_ \"GenMsgCycleTime\" ENUM \"10\",\"20\";"), 20'000'000);
  EXPECT_EQ(period_ns("\"20\";BA_DEF_ BO_ \"GenMsgCycleTime\" ENUM \"10\",\"20\";"), 20'000'000);
  for (const std::string wrong :
       {"ten;", "1,5;", "nan;", "inf;", "0x10;", "\"\";", "1e999;", "-5;", "0.0001;", "1e8;"}) {
    EXPECT_NE(refusal(message + wrong), "") << wrong;
  }
  for (const std::string wrong : {"2;", "\"30\";", "-1;"}) {
    EXPECT_NE(refusal(message + wrong + "BA_DEF_ BO_ \"GenMsgCycleTime\" ENUM \"10\",\"20\";")
                  .find("line 2: message M"),
              std::string::npos)
        << wrong;
  }
}

TEST(DbcReader, PeriodDistanceDeadlineAndBurst) {
  const auto messages = read(
      "BO_ 512 Late : 4 A\nBO_ 256 Early: 8 B\nBO_ 3 Tick: 8 B\n"
      "BA_DEF_DEF_ \"GenMsgCycleTime\" 100;\n"
      "BA_ \"GenMsgCycleTime\" BO_ 256 2.5;\n"
      "BA_ \"GenMsgDelayTime\" BO_ 512 20;\nBA_ \"Awaited\" BO_ 3 1;\n");
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].name, "Early");
  EXPECT_EQ(messages[0].period_ns, 2'500'000);
  EXPECT_EQ(messages[0].distance_ns, 2'500'000);
  EXPECT_EQ(messages[0].deadline_ns, 2'500'000);
  // Nothing bounds its frames on changes but their distance.
  EXPECT_EQ(messages[1].period_ns, 20'000'000);
  EXPECT_EQ(messages[1].deadline_ns, 100'000'000);
  const auto burst = read(
      "BO_ 1 M: 8 A\nBA_ \"GenMsgCycleTime\" BO_ 1 10;\nBA_ \"GenMsgDelayTime\" BO_ 1 2;\n"
      "BA_ \"Burst\" BO_ 1 3;\nBA_ \"Deadline\" BO_ 1 4;\n");
  EXPECT_EQ(burst[0].period_ns, 10'000'000);
  EXPECT_EQ(burst[0].distance_ns, 2'000'000);
  EXPECT_EQ(burst[0].burst, 3);
  EXPECT_EQ(burst[0].deadline_ns, 4'000'000);
}

TEST(DbcReader, WhatIsNotTakenIntoAccount) {
  const std::string text = "BO_ 1 M: 8 A\nBA_ \"GenMsgCycleTime\" BO_ 1 100;\n";
  expect_same(read(text), read(text + "BO_TX_BU_ 1 : A,B;"), text);
  expect_same(read(text),
              read(text + "BA_ \"GenMsgCycleTimeFast\" BO_ 1 10;BA_ \"GenMsgNrOfRepetition\" BO_ 1 3;"),
              text);
}

TEST(DbcReader, FormatsComeFromIdentifierLengthAndVFrameFormat) {
  const DbcOptions options{.default_distance_ms = 10, .has_data_bitrate = true};
  const std::string definition =
      "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\",\"reserved\",\"J1939PG\",\"StandardCAN_FD\";"
      "BA_DEF_ BO_ \"CANFD_BRS\" ENUM \"0\",\"1\";BA_DEF_DEF_ \"VFrameFormat\" \"StandardCAN\";";
  const auto format = [&](const std::string& text) { return read(definition + text, options)[0].format; };
  EXPECT_EQ(format("BO_ 1 M: 8 A"), FrameFormat{});
  EXPECT_EQ(format("BO_ 2147483649 M: 8 A"), FrameFormat{.extended = true});
  EXPECT_EQ(format("BO_ 1 M: 12 A"), (FrameFormat{.fd = true, .bit_rate_switch = true}));
  EXPECT_EQ(format("BO_ 1 M: 8 A BA_ \"VFrameFormat\" BO_ 1 4;"),
            (FrameFormat{.fd = true, .bit_rate_switch = true}));
  EXPECT_EQ(format("BO_ 1 M: 8 A BA_ \"VFrameFormat\" BO_ 1 4; BA_ \"CANFD_BRS\" BO_ 1 0;"),
            FrameFormat{.fd = true});
  EXPECT_EQ(format("BO_ 2147483649 M: 8 A BA_ \"VFrameFormat\" BO_ 2147483649 3;"),
            FrameFormat{.extended = true});
  EXPECT_EQ(
      read("BO_ 1 M: 8 A BA_ \"VFrameFormat\" BO_ 1 14; BA_DEF_ BO_ \"VFrameFormat\" INT 0 15;", options)[0]
          .format,
      (FrameFormat{.fd = true, .bit_rate_switch = true}));
  const auto wrong = [&](const std::string& text) { return refusal(definition + text, options); };
  EXPECT_NE(wrong("BO_ 2147483649 M: 9 A BA_ \"VFrameFormat\" BO_ 2147483649 3;").find("TP.DT"),
            std::string::npos);
  EXPECT_NE(wrong("BO_ 1 M: 8 A BA_ \"VFrameFormat\" BO_ 1 2;").find("'reserved'"), std::string::npos);
  EXPECT_NE(wrong("BO_ 1 M: 65 A").find("0 to 64 bytes"), std::string::npos);
  EXPECT_NE(wrong("BO_ 1 M: -1 A").find("0 to 64 bytes"), std::string::npos);
  EXPECT_NE(refusal("BO_ 1 M: 9 A", {.default_distance_ms = 10}).find("--data-bitrate"), std::string::npos);
  EXPECT_EQ(refusal("BO_ 1 M: 9 A BA_ \"CANFD_BRS\" BO_ 1 0;", {.default_distance_ms = 10}), "");
}

TEST(DbcReader, MessagesComeInTheOrderOfPriority) {
  const auto messages =
      read("BO_ 2147745792 Long: 8 A\nBO_ 2 Next: 8 A\nBO_ 1 Short: 8 A\n", {.default_distance_ms = 10});
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[0].name, "Short");
  EXPECT_EQ(messages[1].name, "Long");
  EXPECT_EQ(messages[2].name, "Next");
}

// ---- what is wrong is named ------------------------------------------------------------------------------------

struct Wrong {
  std::string text;
  std::string begin;  // of the message
};

TEST(DbcReader, WhatIsWrongIsNamedWithItsLine) {
  const std::string good = "BO_ 1 M: 8 A\n";
  const std::vector<Wrong> wrongs = {
      {"", "no message (BO_)"},
      {"BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 A\n", "no message (BO_)"},
      {"nothing", "line 1: 'nothing' begins no DBC statement"},
      {good + "\r\n\rCM_ \"a\n\nb", "line 4: a text begins here that has no end"},
      {"BO_ 1 M: 8\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" A\n", "line 1: message M has no sender"},
      {"BO_ 1 M: 8\n", "line 1: message M has no sender"},
      {"BO_ 99999999999 M: 8 A\n", "line 1: '99999999999' is no number in range"},
      {"BO_ 1 M: eight A\n", "line 1: 'eight' is no number in range"},
      {"BO_ 0x100 M: 8 A\n", "line 1: '0x100' is no number in range"},
      {"BO_ 2048 M: 8 A\n", "line 1: message M: identifier 2048 has more than 11 bits"},
      {"BO_ 3221225473 M: 8 A\n", "line 1: message M: identifier 3221225473 has more than 29 bits"},
      {good + "BO_ 2 N: 8 A\nBO_ 1 O: 8 A\n", "line 3: identifier 1 is there twice, first in line 1"},
      {good + "BA_ \"GenMsgCycleTime\" BO_ 2 5;\n",
       "line 2: GenMsgCycleTime of message 2, which is not there"},
      {good + "BA_ \"GenMsgCycleTime\" BO_ 1 5;\nBA_ \"GenMsgCycleTime\" BO_ 1 6;\n",
       "line 3: GenMsgCycleTime is given again"},
      {good + "BA_DEF_DEF_ \"GenMsgCycleTime\" 5;\nBA_DEF_DEF_ \"GenMsgCycleTime\" 6;\n",
       "line 3: GenMsgCycleTime is given again"},
      {good + "BA_DEF_ BO_ \"Burst\" INT;\nBA_DEF_ BO_ \"Burst\" INT;\n",
       "line 3: attribute Burst of messages is defined twice"},
      {good + "BA_DEF_ BO_ \"Burst\" LONG;\n", "line 2: 'LONG' is no type"},
      {good + "BA_ \"Burst\" BO_ 1 1.5;\n", "line 1: message M: Burst goes from 1 to 1000"},
      {good + "BA_ \"GenMsgCycleTime\" BO_ 1 5;\nBA_ \"GenMsgDelayTime\" BO_ 1 6;\n",
       "line 1: message M: GenMsgDelayTime"},
      {good + "BA_ \"GenMsgSendType\" BO_ 1 1;\nBA_DEF_DEF_ \"GenMsgCycleTime\" 5;",
       "line 2: message M: nothing says what"},
      {good + "SG_ s : 0|8@1+ (1,0) [0|0] \"\" A\nGhost\n", "line 3: 'Ghost' begins no DBC statement"},
      {"SG_ s : 0|8@1+ (1,0) [0|0] \"\" A\n" + good, "line 1: a signal (SG_) before every message"},
      {std::string("BO_ 1 M: 8 A\0", 13), "line 1: byte 0x00"},
      {"BO_ 1 M\x1B[2J: 8 A\n", "line 1: byte 0x1B"},
      {std::string("\xFF\xFE"
                   "B\0O\0_\0",
                   8),
       "line 1: UTF-16"},
  };
  for (const Wrong& wrong : wrongs) {
    EXPECT_EQ(refusal(wrong.text, {.default_distance_ms = 10}).rfind(wrong.begin, 0), 0U)
        << wrong.text << "\n"
        << refusal(wrong.text, {.default_distance_ms = 10});
  }
  EXPECT_NE(
      refusal(good).find(
          "line 1: message M: neither GenMsgCycleTime nor GenMsgDelayTime: give one, or --default-distance-ms"),
      std::string::npos);
}

TEST(DbcReader, SizesAreLimited) {
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

TEST(DbcReader, AFileThatCannotBeReadIsNamed) {
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
