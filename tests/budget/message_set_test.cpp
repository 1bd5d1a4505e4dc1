// SPDX-License-Identifier: Apache-2.0
// The message table and its DBC are one message set.
#include "sil/budget/message_set.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "sil/budget/dbc_reader.hpp"

namespace striker::sil {
namespace {

TEST(MessageSet, TheCommittedDbcIsTheTable) {
  const auto table = table_messages();
  const auto dbc = read_dbc(std::filesystem::path(STRIKER_DBC), {});
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

TEST(MessageSet, TheControllersFramesAreAsLateAsItsStep) {
  auto messages = table_messages();
  set_jitter(messages, {.controller_ns = 7, .others_ns = 3});
  EXPECT_EQ(find_message(messages, "WheelCommand")->jitter_ns, 7);
  EXPECT_EQ(find_message(messages, "Status")->jitter_ns, 7);
  EXPECT_EQ(find_message(messages, "WheelState")->jitter_ns, 3);
  EXPECT_EQ(find_message(messages, "Unheard"), nullptr);
}

}  // namespace
}  // namespace striker::sil
