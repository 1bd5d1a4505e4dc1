// SPDX-License-Identifier: Apache-2.0
// A short match in this process, as somebody sees it who hears the buses and the referee and knows nothing else.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "firmware/can/codec.hpp"
#include "firmware/can/messages.hpp"
#include "sil/match/play/match_links.hpp"
#include "sil/match/play/match_setting.hpp"
#include "sil/match/team/strategies.hpp"

namespace striker::sil {

struct ShortMatch {
  MatchSetting setting;
  std::array<std::unique_ptr<Strategy>, 2> strategies;
  MatchLinks links = links_in_process();
  MatchEnd end;
  Ruling last;

  explicit ShortMatch(const MatchSetting& how) : setting(how) {
    for (const Team team : teams) {
      strategies[index_of(team)] = make_strategy(setting.teams[index_of(team)], team_seed(setting, team));
    }
  }

  void play(
      const std::vector<MatchObserver*>& records, const std::vector<Observer*>& buses,
      const std::function<bool()>& stop = [] { return false; }) {
    play(plan_of(setting), records, buses, stop);
  }
  void play(
      const MatchPlan& plan, const std::vector<MatchObserver*>& records, const std::vector<Observer*>& buses,
      const std::function<bool()>& stop = [] { return false; }) {
    MatchParts parts{
        .teams = {strategies[0].get(), strategies[1].get()}, .links = {}, .records = records, .buses = buses};
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      parts.links[robot] = links[robot].get();
    }
    MatchRun run(plan, parts);
    end = run.run(stop);
    last = run.ruling();
  }
};

// A hash of every frame on every bus, and how many there were.
class BusHash final : public Observer {
 public:
  void end_tick(const Snapshot& snapshot) override {
    for (const RobotSnapshot& robot : snapshot.robots) {
      for (const StampedFrame& frame : robot.frames) {
        take(frame.frame.id);
        for (std::size_t i = 0; i < frame.frame.length; ++i) {
          take(frame.frame.data[i]);
        }
        ++frames_;
      }
    }
  }
  [[nodiscard]] std::uint64_t hash() const { return hash_; }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }

 private:
  void take(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001B3; }

  std::uint64_t hash_ = 0xCBF29CE484222325;
  std::uint64_t frames_ = 0;
};

}  // namespace striker::sil
