// SPDX-License-Identifier: Apache-2.0
// A match on paper (played_match.hpp) that is shown to observers as whoever runs a match shows it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sil/match/record/match_frame.hpp"
#include "sil/match/record/statistics/match_statistics.hpp"
#include "tests/match/played_match.hpp"

namespace striker::sil {

class StatisticsObserver final : public MatchObserver {
 public:
  void frame(const MatchFrame& frame) override { statistics.add(frame); }
  MatchStatistics statistics;
};

inline MatchHeader test_header(const MatchRules& rules = official()) {
  MatchHeader header;
  header.teams = {"rules", "striker"};
  header.seed = 7;
  header.rules = rules;
  header.rule_set = "official";
  header.plant = "servo";
  header.identities = {"", "0badcafe"};
  return header;
}

class RecordedMatch {
 public:
  explicit RecordedMatch(std::vector<MatchObserver*> observers = {}, const MatchRules& rules = official())
      : match(rules), observers_(std::move(observers)) {
    observers_.push_back(&watch_);
    for (MatchObserver* observer : observers_) {
      observer->begin(test_header(rules));
    }
    for (RobotRecord& robot : robots) {
      robot.state = core::State::active;
    }
    show(match.frame);
  }

  const Ruling& step() {
    const RefereeFrame seen = match.frame;
    match.step();
    ++number_;
    show(seen);
    return match.ruling();
  }
  void run(int time_ms) {
    for (int ran_ms = 0; ran_ms < time_ms; ran_ms += frame_ms) {
      step();
    }
  }
  void run_until_play() {
    while (match.ruling().state == GameState::pause) {
      step();
    }
  }
  // Into open play, with the ball at rest for statistics, at (0.6, 0).
  void open_play() {
    run_until_play();
    ball(0.6, 0.0);
    step();
  }
  void finish(bool complete = true) {
    for (MatchObserver* observer : observers_) {
      observer->end({.complete = complete, .state_hash = 0x0123456789abcdef});
    }
  }

  // Fast for the referee, so that no deadlock comes up; its velocity is given apart.
  void ball(double x_m, double y_m, Vec2 velocity_m_s = {}) {
    match.ball(x_m, y_m);
    velocity = {velocity_m_s.x, velocity_m_s.y, 0.0};
  }
  void touch(std::size_t robot) { match.touch(robot); }
  // A frame in which these touch the ball.
  void touched_by(std::initializer_list<std::size_t> touchers) {
    for (const std::size_t robot : touchers) {
      touch(robot);
    }
    step();
  }

  const MatchFigures& figures() const { return watch_.statistics.figures(); }
  const TeamFigures& figures(Team team) const { return figures().teams[index_of(team)]; }

  PlayedMatch match;
  std::array<RobotRecord, robots_in_match> robots = {};
  std::array<double, 3> velocity = {};
  std::array<std::optional<TeamOrders>, 2> orders = {};

 private:
  void show(const RefereeFrame& seen) {
    const MatchFrame frame = {.number = number_,
                              .seen = seen,
                              .ruling = match.ruling(),
                              .ball_velocity_m_s = velocity,
                              .robots = robots,
                              .orders = orders};
    for (MatchObserver* observer : observers_) {
      observer->frame(frame);
    }
  }

  StatisticsObserver watch_;
  std::vector<MatchObserver*> observers_;
  std::int64_t number_ = 0;
};

}  // namespace striker::sil
