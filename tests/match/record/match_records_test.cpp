// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/match_records.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/match/record/scratch.hpp"

namespace striker::sil {
namespace {

constexpr const char* files[] = {"events.jsonl", "frames.csv", "match.json", "match.log.gz"};

void record_into(const std::filesystem::path& directory) {
  const auto records = match_records(directory);
  std::vector<MatchObserver*> observers;
  observers.reserve(records.size());
  for (const auto& record : records) {
    observers.push_back(record.get());
  }
  RecordedMatch play(observers, short_rules());
  play_short_match(play);
  for (const char* file : files) {
    EXPECT_FALSE(std::filesystem::exists(directory / file)) << file;  // not before it is whole
  }
  play.finish();
}

TEST(MatchRecords, AreTheSameBytesForTheSameMatch) {
  const Scratch scratch;
  record_into(scratch / "once");
  record_into(scratch / "again");
  for (const char* file : files) {
    const std::string text = text_of(scratch / "once" / file);
    EXPECT_FALSE(text.empty()) << file;
    EXPECT_EQ(text, text_of(scratch / "again" / file)) << file;
  }
}

TEST(MatchRecords, LeaveNothingElseBehind) {
  const Scratch scratch;
  record_into(scratch.path());
  const std::filesystem::directory_iterator entries(scratch.path());
  EXPECT_EQ(static_cast<std::size_t>(std::distance(begin(entries), end(entries))), std::size(files));
}

TEST(MatchRecords, NameADirectoryThatCannotBeMade) {
  const Scratch scratch;
  std::ofstream(scratch / "file") << "in the way";
  try {
    static_cast<void>(match_records(scratch / "file" / "match"));
    FAIL() << "it was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find((scratch / "file").string()), std::string::npos) << error.what();
  }
}

TEST(MatchRecords, TimingIsAFileOfItsOwn) {
  const Scratch scratch;
  write_timing({.simulated_s = 612.0, .wall_s = 12.0}, scratch.path());
  const auto timing = nlohmann::json::parse(text_of(scratch / "timing.json"));
  EXPECT_EQ(timing, (nlohmann::json{{"simulated_s", 612.0}, {"wall_s", 12.0}, {"realtime_factor", 51.0}}));
}

}  // namespace
}  // namespace striker::sil
