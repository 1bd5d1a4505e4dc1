// SPDX-License-Identifier: Apache-2.0
// Places, control, discipline, flow and the firmware's own figures.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/match/random_frames.hpp"
#include "tests/match/record/recorded_match.hpp"

namespace striker::sil {
namespace {

TEST(Places, ThirdsAddUpToTheClock) {
  RecordedMatch play;
  play.open_play();
  play.ball(1.31, 0.0);
  play.run(1'000);
  play.ball(-1.31, 0.0);
  play.run(500);
  play.ball(1.29, 0.0);
  play.run(250);
  EXPECT_EQ(play.figures(Team::red).attacking_third_ms, 1'000);
  EXPECT_EQ(play.figures(Team::blue).attacking_third_ms, 500);
  EXPECT_EQ(play.figures().middle_third_ms, 300);  // with the kickoff's frame
  EXPECT_EQ(play.figures().played_ms(), 1'800);
}

TEST(Places, AnEntryIsOfTheTeamInPossession) {
  RecordedMatch play;
  play.open_play();
  play.ball(2.9, 0.0);
  play.touched_by({red(3)});
  play.ball(3.1, 0.0);
  play.run(200);
  EXPECT_EQ(play.figures(Team::red).penalty_area_entries, 1);
  play.ball(2.9, 0.0);
  play.step();
  play.ball(3.1, 0.0);
  play.touched_by({blue(1)});  // its own area
  EXPECT_EQ(play.figures(Team::red).penalty_area_entries, 1);
  EXPECT_EQ(play.figures(Team::blue).penalty_area_entries, 0);
}

TEST(Control, AsksForDistanceBearingAndHeight) {
  struct Case {
    const char* what;
    double x_m;  // of the ball; the robot is at 0
    double heading_rad;
    double height_m;
    double speed_m_s;
    bool has_ball;
  };
  constexpr double near_45_deg = std::numbers::pi / 4.0 - 0.01;
  for (const Case& one :
       {Case{"near", 0.18, 0.0, 0.05, 0.0, true}, Case{"far", 0.20, 0.0, 0.05, 0.0, false},
        Case{"far and fast", 0.20, 0.0, 0.05, 0.6, true}, Case{"aside", 0.18, near_45_deg, 0.05, 0.0, true},
        Case{"behind", 0.18, near_45_deg + 0.02, 0.05, 0.0, false},
        Case{"above", 0.18, 0.0, 0.06, 0.0, false}}) {
    RecordedMatch play;
    play.open_play();
    play.match.frame.robots[red(3)] = {1.0, 1.0, one.heading_rad};
    play.ball(1.0 + one.x_m, 1.0, {one.speed_m_s, 0.0});
    play.match.frame.ball.height_m = one.height_m;
    play.run(100);
    EXPECT_EQ(play.figures(Team::red).control_ms, one.has_ball ? 100 : 0) << one.what;
    EXPECT_EQ(play.figures(Team::blue).control_ms, 0) << one.what;
  }
}

TEST(Keeper, IsMeasuredFromItsLineAndToTheBall) {
  RecordedMatch play;
  play.open_play();
  const int before = play.figures(Team::blue).keeper_frames;
  const double line_before_m = play.figures(Team::blue).keeper_line_sum_m;
  const double lag_before_m = play.figures(Team::blue).keeper_lag_sum_m;
  play.match.put(blue(0), 3.6, 0.2);
  play.ball(1.0, 2.0);  // beyond the post: 0.5 counts
  play.step();
  EXPECT_EQ(play.figures(Team::blue).keeper_frames, before + 1);
  EXPECT_NEAR(play.figures(Team::blue).keeper_line_sum_m - line_before_m, 0.3, 1e-12);
  EXPECT_NEAR(play.figures(Team::blue).keeper_lag_sum_m - lag_before_m, 0.3, 1e-12);
}

TEST(Discipline, SetPiecesAreCountedByCause) {
  RecordedMatch play;
  play.open_play();
  play.touch(blue(1));
  play.ball(-3.95, 1.0);  // behind red's line by blue: red's goal kick
  play.step();
  EXPECT_EQ(play.figures(Team::red).goal_kicks.after_out, 1);
  EXPECT_EQ(play.figures(Team::blue).corners.total(), 0);

  RecordedMatch crowd;
  crowd.open_play();
  for (const std::size_t id : {1U, 2U, 3U}) {
    crowd.match.put(red(id), 3.2, 0.2 * static_cast<double>(id));
  }
  crowd.ball(3.1, 0.0);
  crowd.step();
  EXPECT_EQ(crowd.figures(Team::blue).goal_kicks.after_crowding, 1);

  RecordedMatch lock;
  lock.open_play();
  lock.match.ball(0.5, 0.5, 0.0);
  lock.run(4'100);
  EXPECT_EQ(lock.figures().deadlocks, 1);
  EXPECT_EQ(lock.figures().drops, 1);
}

TEST(Discipline, SendOutsAreCountedByCauseAndTime) {
  RecordedMatch play;
  play.open_play();
  play.match.frame.standing.reset(red(2));
  play.match.put(blue(3), 5.0, 1.5);
  play.run(3'100);
  EXPECT_EQ(play.figures(Team::red).fallen, 1);
  EXPECT_EQ(play.figures(Team::blue).left_field, 1);
  EXPECT_EQ(play.figures(Team::blue).out_ms, 3'050);  // from the first of 62 frames
  play.match.put(red(4), 3.7, 0.3);
  play.run(1'100);
  EXPECT_EQ(play.figures(Team::red).sent_home, 1);
  EXPECT_EQ(play.figures(Team::red).keeper_sent_out, 1);
  play.match.put(blue(0), 0.0, 1.5);
  play.run(3'100);
  EXPECT_EQ(play.figures(Team::blue).keeper_sent_home, 1);
}

TEST(Flow, TimeInStatesIsSimulatedTime) {
  RecordedMatch play;
  play.open_play();
  play.ball(4.0, 0.0);
  play.step();
  play.run(8'000);
  EXPECT_EQ(play.figures().state_ms[static_cast<std::size_t>(GameState::pause)], 5'000);
  EXPECT_EQ(play.figures().state_ms[static_cast<std::size_t>(GameState::kickoff)], 50 + 3'000);
  EXPECT_EQ(play.figures().sim_ms, 9'100);
  EXPECT_EQ(play.figures().played_ms(), 4'100);
}

TEST(Robots, AreMeasuredWhileTheyMayPlay) {
  RecordedMatch play;
  play.robots[red(3)].order_age_ms = 1'000;
  play.run_until_play();  // a pause: nothing is measured
  play.robots[red(3)].order_age_ms = 20;
  play.robots[red(3)].saturated_ticks = 10;
  play.step();  // locked in the kickoff
  play.ball(0.6, 0.0);
  play.step();  // so far
  play.match.frame.robots[red(3)].x_m += 0.1;
  play.step();
  play.robots[red(3)].order_age_ms = 60;
  play.robots[red(3)].state = core::State::standby;
  play.step();
  play.robots[red(3)].order_age_ms.reset();
  play.step();
  const RobotFigures& figures = play.figures().robots[red(3)];
  EXPECT_EQ(figures.play_frames, 3);
  EXPECT_EQ(figures.order_frames, 2);
  EXPECT_EQ(figures.order_age_sum_ms, 80);
  EXPECT_EQ(figures.order_age_max_ms, 60);
  EXPECT_EQ(figures.saturated_ticks, 30);
  EXPECT_EQ(figures.undriven_ms, 100);
  EXPECT_NEAR(figures.way_m, 0.1, 1e-12);
}

// Whatever it said last: its status comes every 10 ms, and twice as long without one is too long.
TEST(Robots, AControllerThatIsNotHeardDrivesNobody) {
  RecordedMatch play;
  play.open_play();
  const int before_ms = play.figures().robots[red(3)].undriven_ms;
  play.robots[red(3)].status_age_ms = 20;
  play.step();
  EXPECT_EQ(play.figures().robots[red(3)].undriven_ms, before_ms);
  play.robots[red(3)].status_age_ms = 21;
  play.step();
  EXPECT_EQ(play.figures().robots[red(3)].undriven_ms, before_ms + 50);
}

TEST(Robots, AFaultIsCountedAsItBegins) {
  RecordedMatch play;
  play.robots[blue(1)].fault = core::Fault::vision_lost;
  play.robots[blue(1)].lost_frames = 2;
  play.step();
  play.step();
  play.robots[blue(1)].fault = core::Fault::none;
  play.robots[blue(1)].lost_frames = 0;
  play.step();
  play.robots[blue(1)].fault = core::Fault::vision_lost;
  play.step();
  const RobotFigures& figures = play.figures().robots[blue(1)];
  EXPECT_EQ(figures.faults[static_cast<std::size_t>(core::Fault::vision_lost)], 2);
  EXPECT_EQ(figures.lost_frames, 4);
}

// Whatever happens, the sums hold.
TEST(Statistics, HoldTheirSumsOnRandomFrames) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    RecordedMatch play;
    RandomFrames frames(seed);
    for (int frame = 0; frame < 20'000; ++frame) {
      play.match.frame = frames.after(play.match.ruling());
      play.velocity = {frame % 7 - 3.0, frame % 5 - 2.0, 0.0};
      play.step();
    }
    const MatchFigures& all = play.figures();
    const TeamFigures& ours = play.figures(Team::red);
    const TeamFigures& theirs = play.figures(Team::blue);
    EXPECT_EQ(ours.goals, all.score[0]);
    EXPECT_EQ(theirs.goals, all.score[1]);
    EXPECT_EQ(ours.attacking_third_ms + theirs.attacking_third_ms + all.middle_third_ms, all.played_ms());
    EXPECT_LE(ours.possession_ms + theirs.possession_ms, all.played_ms());
    EXPECT_GT(ours.possession_ms, 0);
    std::int64_t sum_ms = 0;
    for (const int state_ms : all.state_ms) {
      sum_ms += state_ms;
    }
    EXPECT_GE(sum_ms, all.sim_ms);  // frames after the end are of state over
    for (const Team team : teams) {
      const TeamFigures& own = play.figures(team);
      const TeamFigures& other = play.figures(opponent_of(team));
      EXPECT_LE(own.shots_on_target, own.shots);
      EXPECT_LE(own.goals - other.own_goals, own.shots_on_target);
      EXPECT_LE(own.saves, other.shots_on_target);
    }
  }
}

}  // namespace
}  // namespace striker::sil
