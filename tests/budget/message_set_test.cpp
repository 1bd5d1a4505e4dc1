// SPDX-License-Identifier: Apache-2.0
// The message table and its DBC are one message set; other DBC files say what is wrong with them.
#include "sil/budget/message_set.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sil/budget/dbc_reader.hpp"

namespace striker::sil {
namespace {

class MessageSet : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    file_ = std::filesystem::temp_directory_path() / (std::string("striker_") + test->name() + ".dbc");
    std::ofstream(file_) << text;
    return file_;
  }
  void TearDown() override { std::filesystem::remove(file_); }

  std::string refusal(const std::string& text, std::int64_t default_distance_ms = 0) {
    try {
      EXPECT_FALSE(read_dbc(write(text), default_distance_ms).empty());
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file_.string()), std::string::npos);
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path file_;
};

TEST_F(MessageSet, TheCommittedDbcIsTheTable) {
  const auto table = table_messages();
  const auto dbc = read_dbc(STRIKER_DBC, 0);
  ASSERT_EQ(table.size(), dbc.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(table[i].name, dbc[i].name);
    EXPECT_EQ(table[i].sender, dbc[i].sender);
    EXPECT_EQ(table[i].id, dbc[i].id);
    EXPECT_EQ(table[i].bytes, dbc[i].bytes);
    EXPECT_EQ(table[i].period_ns, dbc[i].period_ns) << table[i].name;
    EXPECT_EQ(table[i].distance_ns, dbc[i].distance_ns) << table[i].name;
    EXPECT_EQ(table[i].burst, dbc[i].burst) << table[i].name;
    EXPECT_EQ(table[i].deadline_ns, dbc[i].deadline_ns) << table[i].name;
  }
}

TEST_F(MessageSet, AForeignDbc) {
  const auto messages = read_dbc(write("BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX\n"
                                       "BO_ 512 Late : 4 A\nBO_ 256 Early: 8 B\n"
                                       "BA_DEF_DEF_ \"GenMsgCycleTime\" 100;\n"
                                       "BA_ \"GenMsgCycleTime\" BO_ 256 2.5;\n"
                                       "BA_ \"GenMsgDelayTime\" BO_ 512 20;\n"),
                                 0);
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].name, "Early");
  EXPECT_EQ(messages[0].period_ns, 2'500'000);
  EXPECT_EQ(messages[0].distance_ns, 2'500'000);
  EXPECT_EQ(messages[0].deadline_ns, 2'500'000);
  // Nothing bounds its frames on changes but their distance.
  EXPECT_EQ(messages[1].period_ns, 20'000'000);
  EXPECT_EQ(messages[1].deadline_ns, 100'000'000);
}

TEST_F(MessageSet, WhatIsWrongIsNamed) {
  EXPECT_NE(refusal("nothing").find("no message (BO_)"), std::string::npos);
  EXPECT_NE(refusal("BO_ 1 M: 8 A\n").find("message M: neither GenMsgCycleTime"), std::string::npos);
  EXPECT_EQ(refusal("BO_ 1 M: 8 A\n", 10), "");
  EXPECT_NE(refusal("BO_ 1 M: 8 A" + std::string(300'000, ' ') + "\n").find("line 1: longer than"),
            std::string::npos);
  EXPECT_EQ(refusal("CM_ \"" + std::string(300'000, ' ') + "\"\nBO_ 1 M: 8 A\n", 10), "");
  EXPECT_NE(refusal("BO_ 2147483649 M: 8 A\n", 10).find("message M: an extended identifier"),
            std::string::npos);
  EXPECT_NE(refusal("BO_ 1 M: 64 A\n", 10).find("more than 8 bytes"), std::string::npos);
  EXPECT_NE(refusal("BO_ 1 M: 8 A\nBO_ 1 N: 8 A\n", 10).find("line 2: identifier 1 is there twice"),
            std::string::npos);
  EXPECT_NE(refusal("BO_ 1 M: 8 A\nBA_ \"GenMsgCycleTime\" BO_ 1 -5;\n").find("0.001"), std::string::npos);
  EXPECT_NE(refusal("BO_ 99999999999 M: 8 A\n").find("line 1: '99999999999' is no number in range"),
            std::string::npos);
  EXPECT_THROW(static_cast<void>(read_dbc("/nonexistent/a.dbc", 0)), std::runtime_error);
}

TEST_F(MessageSet, TheControllersFramesAreAsLateAsItsStep) {
  auto messages = table_messages();
  set_jitter(messages, {.controller_ns = 7, .others_ns = 3});
  EXPECT_EQ(find_message(messages, "WheelCommand")->jitter_ns, 7);
  EXPECT_EQ(find_message(messages, "Status")->jitter_ns, 7);
  EXPECT_EQ(find_message(messages, "WheelState")->jitter_ns, 3);
  EXPECT_EQ(find_message(messages, "Unheard"), nullptr);
}

}  // namespace
}  // namespace striker::sil
