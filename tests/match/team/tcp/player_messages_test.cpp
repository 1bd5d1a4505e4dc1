// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/tcp/player_messages.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sil/world/random.hpp"

namespace striker::sil {
namespace {

TEST(PlayerMessages, ReadsNameAndNumbers) {
  PlayerMessages messages;
  messages.add(R"(aiwc.set_speeds("k3y", 1.5, -2, 1e-05, 0))");
  const auto message = messages.next();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->name, "set_speeds");
  EXPECT_EQ(message->numbers, (std::vector<double>{1.5, -2.0, 1e-5, 0.0}));
  EXPECT_FALSE(messages.next());
  EXPECT_FALSE(messages.is_broken());
}

TEST(PlayerMessages, ReadsOneAfterTheOther) {
  PlayerMessages messages;
  messages.add(
      "aiwc.get_info(\"k\")aiwc.commentate(\"k\", \"aiwc.ready(1) he said\")\n aiwc.ready( \"k\" ) ");
  EXPECT_EQ(messages.next()->name, "get_info");
  EXPECT_EQ(messages.next()->name, "commentate");
  EXPECT_EQ(messages.next()->name, "ready");
  EXPECT_FALSE(messages.next());
  EXPECT_FALSE(messages.is_broken());
}

TEST(PlayerMessages, WaitsForTheRestWhereverItWasCut) {
  const std::string text = R"(aiwc.set_speeds("k", 1.25, -20.5)aiwc.ready())";
  for (std::size_t cut = 0; cut < text.size(); ++cut) {
    SCOPED_TRACE(cut);
    PlayerMessages messages;
    std::vector<PlayerMessage> read;
    const auto add = [&](std::string_view part) {
      messages.add(part);
      while (auto message = messages.next()) {
        read.push_back(*message);
      }
    };
    add(std::string_view(text).substr(0, cut));
    add(std::string_view(text).substr(cut));
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[0].numbers, (std::vector<double>{1.25, -20.5}));
    EXPECT_FALSE(messages.is_broken());
  }
}

TEST(PlayerMessages, BreaksAtWhatIsNone) {
  for (const char* const text :
       {"hello", "aiwc,ready()", "aiwc.Ready()", "aiwc.ready)", "aiwc.ready(\"k\" \"k\")", "aiwc.ready(,)",
        "aiwc.ready(1.0.0)", "aiwc.ready(--1)", "aiwc.ready(one)", "aiwc.ready(1,)", "{\"a\": 1}"}) {
    SCOPED_TRACE(text);
    PlayerMessages messages;
    messages.add(text);
    EXPECT_FALSE(messages.next());
    EXPECT_TRUE(messages.is_broken());
    messages.add("aiwc.ready()");
    EXPECT_FALSE(messages.next());
  }
}

TEST(PlayerMessages, TakesNumbersThatAreNoneAsTheyAre) {
  PlayerMessages messages;
  messages.add("aiwc.set_speeds(nan, inf, -inf)");
  const auto message = messages.next();
  ASSERT_TRUE(message);
  EXPECT_TRUE(std::isnan(message->numbers[0]));
  EXPECT_TRUE(std::isinf(message->numbers[1]));
}

TEST(PlayerMessages, BreaksAtAMessageWithoutEnd) {
  for (const char* const part : {"1, ", "\"", "a", " "}) {
    SCOPED_TRACE(part);
    PlayerMessages messages;
    messages.add("aiwc.comment(\"");
    int added = 0;
    while (!messages.is_broken() && added < 200'000) {
      messages.add(part);
      ++added;
      if (const auto message = messages.next()) {
        FAIL();
      }
    }
    EXPECT_LT(added, 20'000);
  }
}

TEST(PlayerMessages, BreaksAtTooManyNumbers) {
  std::string text = "aiwc.set_speeds(0";
  for (int number = 1; number < 65; ++number) {
    text += ", 0";
  }
  PlayerMessages messages;
  messages.add(text + ")");
  EXPECT_FALSE(messages.next());
  EXPECT_TRUE(messages.is_broken());
}

// Text out of the alphabet of messages: no crash, no message that holds more than it may.
TEST(PlayerMessages, SurvivesAnyText) {
  constexpr std::string_view parts[] = {"aiwc.", "set_speeds", "(", ")", "\"",  ",",
                                        "1.5",   "-",          "e", " ", "nan", "\0x"};
  Random random(1, 2, 3);
  int whole = 0;
  for (int round = 0; round < 100'000; ++round) {
    PlayerMessages messages;
    for (std::uint64_t part = random.below(12); part > 0; --part) {
      messages.add(parts[random.below(std::size(parts))]);
      while (const auto message = messages.next()) {
        ASSERT_LE(message->numbers.size(), 64U);
        ++whole;
      }
    }
  }
  EXPECT_GT(whole, 20);
}

}  // namespace
}  // namespace striker::sil
