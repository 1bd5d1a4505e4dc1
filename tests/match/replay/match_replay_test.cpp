// SPDX-License-Identifier: Apache-2.0
#include "sil/match/replay/match_replay.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "sil/match/record/match_report.hpp"
#include "sil/match/replay/bus_logs.hpp"
#include "sil/match/replay/recorded_plan.hpp"
#include "tests/match/play/watched_match.hpp"

namespace striker::sil {
namespace {

class MatchReplayed : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(directory_);
    ShortMatch match(setting_);
    BusLogs logs(directory_, robots_in_match);
    MatchReport report(report_);
    match.play({&report}, {&logs});
    end_ = match.end;
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  MatchReplay replay() {
    again_ = {};
    const std::array<MatchObserver*, 1> records = {&again_};
    return replay_match(plan_of(setting_), 1'000'000, directory_, links_in_process(), records,
                        [] { return false; });
  }

  std::string text_of(std::size_t robot) {
    BusLogReader reader(bus_log_file(directory_, robot));
    std::string text;
    while (const auto line = reader.next()) {
      text += *line + '\n';
    }
    return text;
  }

  // Replaces one line of a robot's log, which is plain text afterwards: a reader takes both.
  void change_line(std::size_t robot, const std::string& with,
                   const std::function<std::string(std::string)>& change) {
    const auto file = bus_log_file(directory_, robot);
    std::string text;
    {
      BusLogReader reader(file);
      bool done = false;
      while (const auto recorded = reader.next()) {
        const std::string& line = *recorded;
        const bool is_it = !done && line.find(with) != std::string::npos;
        text += (is_it ? change(line) : line) + '\n';
        done = done || is_it;
      }
      ASSERT_TRUE(done);
    }
    std::ofstream(file) << text;
  }

  struct Again final : MatchObserver {
    void frame(const MatchFrame& frame) override { statistics.add(frame); }
    MatchStatistics statistics;
  };

  MatchSetting setting_ = {.teams = {"rules", "random"}, .seed = 8, .half_s = 4};
  std::filesystem::path directory_ =
      std::filesystem::path(::testing::TempDir()) /
      ("match_replay_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
  std::filesystem::path report_ = directory_ / "match.json";
  Again again_;
  MatchEnd end_;
};

TEST_F(MatchReplayed, TheSameMatchComesOut) {
  const MatchReplay again = replay();
  EXPECT_FALSE(again.difference) << again.difference->recorded << " is now " << again.difference->now;
  EXPECT_EQ(again.end.state_hash, end_.state_hash);
  EXPECT_GT(again.frames, 100'000U);
}

// The robots are ordered to drive in all of these frames but the first ones.
TEST_F(MatchReplayed, AMatchThatWasStoppedInAnyFrameComesOutAgain) {
  for (const int frames : {0, 1, 2, 40, 41, 60}) {
    {
      ShortMatch match(setting_);
      BusLogs logs(directory_, robots_in_match);
      MatchReport report(report_);
      match.play({&report}, {&logs}, [left = frames]() mutable { return left-- == 0; });
    }
    const RecordedMatch recorded = read_match(report_);
    EXPECT_EQ(recorded.frames, frames);
    again_ = {};
    const std::array<MatchObserver*, 1> records = {&again_};
    const MatchReplay again = replay_match(recorded.plan, recorded.frames, directory_, links_in_process(),
                                           records, [] { return false; });
    EXPECT_FALSE(again.difference) << frames << ": " << again.difference->recorded;
    const auto now = match_json(recorded.plan.header, again_.statistics.figures(), again.end);
    EXPECT_EQ(first_other_value(report_, now), std::nullopt) << frames;
  }
}

// But for what the match is played by anew: with another one of these it is another match.
TEST_F(MatchReplayed, EveryEditedFigureOfTheReportIsFound) {
  const std::set<std::string> played_by = {"/seed",       "/plant",  "/slip",     "/jitter_m",
                                           "/jitter_rad", "/faults", "/rule_set", "/rules/half_ms"};
  const std::set<std::string> of_build = {"/version", "/git_hash", "/build_type"};
  const MatchReplay again = replay();
  const auto other_value = [&] {
    const MatchHeader header = read_match(report_).plan.header;
    return first_other_value(report_, match_json(header, again_.statistics.figures(), again.end));
  };
  EXPECT_EQ(other_value(), std::nullopt);
  const auto sound = nlohmann::json::parse(std::ifstream(report_));
  const auto flat = sound.flatten();
  int edited = 0;
  for (const auto& [path, value] : flat.items()) {
    if (played_by.contains(path) || of_build.contains(path)) {
      continue;
    }
    auto other = sound;
    other[nlohmann::json::json_pointer(path)] =
        value.is_string() ? nlohmann::json("other") : nlohmann::json(-17);
    std::ofstream(report_) << other;
    try {
      EXPECT_TRUE(other_value()) << path;
    } catch (const std::runtime_error&) {  // it has no meaning any more
    }
    ++edited;
  }
  EXPECT_GT(edited, 200);
}

TEST_F(MatchReplayed, OneAlteredBitOfACommandIsFound) {
  change_line(7, "(0000000002.034000) vcan7 050#", [](std::string line) {
    line.back() = line.back() == '0' ? '1' : '0';
    return line;
  });
  const MatchReplay again = replay();
  ASSERT_TRUE(again.difference);
  EXPECT_EQ(again.difference->robot, 7U);
  EXPECT_EQ(again.difference->tick, 2'034U);
}

TEST_F(MatchReplayed, OneAlteredOrderChangesTheMatchFromItsFrameOn) {
  change_line(9, "(0000000003.000000) vcan9 084#", [](std::string line) {
    line.replace(line.size() - 4, 4, "0000");
    return line;
  });
  const MatchReplay again = replay();
  ASSERT_TRUE(again.difference);
  EXPECT_EQ(again.difference->robot, 9U);
  EXPECT_EQ(again.difference->tick, 3'000U);
}

TEST_F(MatchReplayed, ALineThatIsMissingIsFound) {
  change_line(2, "(0000000005.100000) vcan2 060#", [](const std::string&) { return std::string(" "); });
  const MatchReplay again = replay();
  ASSERT_TRUE(again.difference);
  EXPECT_EQ(again.difference->robot, 2U);
}

TEST_F(MatchReplayed, WhatWasCutOffOrAddedIsFound) {
  const std::string whole = text_of(5);
  std::string prolonged = whole;
  prolonged.append("\n");
  std::string doubled = prolonged;
  doubled.append(whole);
  for (const std::string& changed : {std::string(), whole.substr(0, whole.size() / 2), prolonged, doubled}) {
    std::ofstream(bus_log_file(directory_, 5)) << changed;
    const MatchReplay again = replay();
    ASSERT_TRUE(again.difference);
    EXPECT_EQ(again.difference->robot, 5U);
  }
}

TEST_F(MatchReplayed, ALogThatIsNotThereIsNamed) {
  std::filesystem::remove(bus_log_file(directory_, 4));
  try {
    (void)replay();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("vcan4.log.gz"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace striker::sil
