// SPDX-License-Identifier: Apache-2.0
// What a DBC file's attributes mean, and what is said of those that cannot be.
#include "sil/budget/dbc_reader.hpp"

#include <gtest/gtest.h>

#include "tests/budget/dbc_text.hpp"

namespace striker::sil {
namespace {

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

}  // namespace
}  // namespace striker::sil
