// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/event_log.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "firmware/host/version.hpp"
#include "tests/match/record/scratch.hpp"

namespace striker::sil {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> log_of_short_match(const std::filesystem::path& file) {
  EventLog log(file);
  RecordedMatch play({&log}, short_rules());
  play_short_match(play);
  play.finish();
  return lines_of(file);
}

TEST(EventLog, BeginsWithTheMatch) {
  const Scratch scratch;
  const Json header = Json::parse(log_of_short_match(scratch / "events.jsonl").front());
  std::vector<std::string> keys;
  for (const auto& [key, value] : header.items()) {
    keys.push_back(key);
  }
  EXPECT_EQ(keys, (std::vector<std::string>{"record", "format", "teams", "identities", "seed", "plant",
                                            "slip", "jitter_m", "jitter_rad", "faults", "rule_set", "rules",
                                            "geometry", "physics", "version", "git_hash", "build_type"}));
  EXPECT_EQ(header["record"], "striker match events");
  EXPECT_EQ(header["teams"], (Json::array({"rules", "striker"})));
  EXPECT_EQ(header["identities"], (Json::array({nullptr, "0badcafe"})));
  EXPECT_EQ(header["seed"], 7);
  EXPECT_EQ(header["rules"]["half_ms"], 10'000);
  EXPECT_EQ(header["rules"]["own_flag_for_sent_out"], true);
  EXPECT_EQ(header["geometry"]["field_half_length_m"], 3.9);
  EXPECT_EQ(header["physics"]["gravity_m_s2"], 9.81);
  EXPECT_EQ(header["git_hash"], host::git_hash());
}

TEST(EventLog, AGoalIsThisLine) {
  const Scratch scratch;
  const std::vector<std::string> lines = log_of_short_match(scratch / "events.jsonl");
  EXPECT_EQ(
      lines[4],
      R"({"seq":3,"t_sim_ns":1150000000,"half":1,"clock_ms":150,"frame":23,"event":"goal","cause":"scored",)"
      R"("team":"red","owner":"blue","robot":null,"set_piece":"kickoff","score":[1,0],"last_touch":[3],)"
      R"("ball":{"position_m":[3.95,0.3],"height_m":0.05,"velocity_m_s":[2.0,0.5,0.0],"speed_m_s":1.0},)"
      R"("exit_m":[3.9,0.2928571428571428],"counts":[1,0],"distances_m":[0.0,0.0],"timer_ms":0,)"
      R"("robot_placement":null,"ball_placement":null,"spot_was_taken":false})");
}

TEST(EventLog, APlacementIsThisLine) {
  const Scratch scratch;
  const std::vector<std::string> lines = log_of_short_match(scratch / "events.jsonl");
  EXPECT_EQ(
      lines[5],
      R"({"seq":4,"t_sim_ns":4150000000,"half":1,"clock_ms":150,"frame":83,"event":"restart",)"
      R"("cause":"after_goal","team":"blue","owner":"blue","robot":null,"set_piece":"kickoff","score":[1,0],)"
      R"("last_touch":[],"ball":{"position_m":[0.0,0.0],"height_m":0.06,"velocity_m_s":[0.0,0.0,0.0],)"
      R"("speed_m_s":0.0},"exit_m":null,"counts":[0,0],"distances_m":[0.0,0.0],"timer_ms":0,)"
      R"("robot_placement":null,"ball_placement":[0.0,0.0,0.06],"spot_was_taken":false})");
}

TEST(EventLog, HasEveryEventOnce) {
  const Scratch scratch;
  EventLog log(scratch / "events.jsonl");
  RecordedMatch play({&log}, short_rules());
  play_short_match(play);
  play.finish();
  const std::vector<std::string> lines = lines_of(scratch / "events.jsonl");
  ASSERT_EQ(lines.size(), play.match.log.size() + 1);
  for (std::size_t i = 0; i < play.match.log.size(); ++i) {
    const Json line = Json::parse(lines[i + 1]);
    const MatchEvent& event = play.match.log[i];
    EXPECT_EQ(line["seq"], i);
    EXPECT_EQ(line["event"], name_of(event.kind));
    EXPECT_EQ(line["cause"], name_of(event.cause));
    EXPECT_EQ(line["timer_ms"], event.timer_ms);
    EXPECT_EQ(line["t_sim_ns"], line["frame"].get<std::int64_t>() * 50'000'000);
  }
  EXPECT_EQ(play.match.count(EventKind::sent_out), 1U);  // the match has something to tell
  EXPECT_EQ(play.match.count(EventKind::ball_out), 1U);
  EXPECT_GE(play.match.count(EventKind::deadlock), 1U);
}

TEST(EventLog, ARobotsEventHasNoOwnerOfTheBall) {
  const Scratch scratch;
  for (const std::string& line : log_of_short_match(scratch / "events.jsonl")) {
    const Json event = Json::parse(line);
    if (event.value("event", "") == "sent_out") {
      EXPECT_EQ(event["team"], "red");
      EXPECT_EQ(event["owner"], nullptr);
      EXPECT_EQ(event["robot"], 1);
      EXPECT_EQ(event["cause"], "fallen");
      EXPECT_EQ(event["timer_ms"], 3'000);
      EXPECT_EQ(event["robot_placement"], (Json::array({-4.05, -1.15, 0.0})));
      return;
    }
  }
  FAIL() << "nobody was sent out";
}

TEST(EventLog, LeavesItsLinesWhenAMatchFails) {
  const Scratch scratch;
  {
    EventLog log(scratch / "events.jsonl");
    RecordedMatch play({&log}, short_rules());
    play.run(2'000);
  }
  EXPECT_FALSE(std::filesystem::exists(scratch / "events.jsonl"));
  EXPECT_EQ(lines_of(scratch / "events.jsonl.part").size(), 3U);
}

}  // namespace
}  // namespace striker::sil
