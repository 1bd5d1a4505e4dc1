// SPDX-License-Identifier: Apache-2.0
// Possession and passes, as match_figures.hpp has them.
#include <gtest/gtest.h>

#include "tests/match/record/recorded_match.hpp"

namespace striker::sil {
namespace {

// The ball lies in the middle of red's attack, where nothing else counts.
RecordedMatch opened() {
  RecordedMatch play;
  play.open_play();
  play.ball(0.5, 1.0);
  play.step();
  return play;
}

TEST(Possession, LastsForThreeSecondsFromATouch) {
  RecordedMatch play;
  play.open_play();
  play.touched_by({red(3)});
  play.run(5'000);
  EXPECT_EQ(play.figures(Team::red).possession_ms, 3'000);
  EXPECT_EQ(play.figures(Team::blue).possession_ms, 0);
}

TEST(Possession, EndsWithTheOpponentsTouch) {
  RecordedMatch play;
  play.open_play();
  play.touched_by({red(3)});
  play.run(450);
  play.touched_by({blue(1)});
  play.run(5'000);
  EXPECT_EQ(play.figures(Team::red).possession_ms, 500);
  EXPECT_EQ(play.figures(Team::blue).possession_ms, 3'000);
}

TEST(Possession, IsNobodysWhenBothTouch) {
  RecordedMatch play;
  play.open_play();
  play.touched_by({red(3)});
  play.touched_by({red(3), blue(1)});
  play.run(5'000);
  EXPECT_EQ(play.figures(Team::red).possession_ms, 50);
  EXPECT_EQ(play.figures(Team::blue).possession_ms, 0);
}

TEST(Possession, EndsWhenPlayStops) {
  RecordedMatch play;
  play.open_play();
  play.touched_by({red(3)});
  play.ball(0.5, 2.4);
  play.step();
  ASSERT_EQ(play.match.ruling().state, GameState::pause);
  play.run(5'000);
  EXPECT_EQ(play.figures(Team::red).possession_ms, 100);
}

TEST(Pass, IsATouchByAnotherOfTheTeamAfterAWay) {
  RecordedMatch play;
  play.open_play();
  play.touched_by({red(3)});
  play.ball(1.0, 0.0);
  play.touched_by({red(4)});
  EXPECT_EQ(play.figures(Team::red).passes, 1);
  EXPECT_EQ(play.figures().robots[red(3)].touches, 1);
  EXPECT_EQ(play.figures().robots[red(4)].touches, 1);
}

TEST(Pass, MeasuresTheWayAndNotTheDistance) {
  RecordedMatch play;
  play.open_play();
  play.touched_by({red(3)});
  play.ball(0.8, 0.0);  // against something, and back
  play.step();
  play.ball(0.6, 0.0);
  play.touched_by({red(4)});
  EXPECT_EQ(play.figures(Team::red).passes, 1);
}

TEST(Pass, IsNoneOverAShortWay) {
  RecordedMatch play;
  play.open_play();
  play.touched_by({red(3)});
  play.ball(0.85, 0.0);
  play.touched_by({red(4)});
  EXPECT_EQ(play.figures(Team::red).passes, 0);
}

TEST(Pass, IsNoneToOneself) {
  RecordedMatch play;
  play.open_play();
  play.touched_by({red(3)});
  play.ball(1.2, 0.0);
  play.touched_by({red(3)});
  EXPECT_EQ(play.figures(Team::red).passes, 0);
}

TEST(Pass, IsNoneToAnOpponent) {
  RecordedMatch play;
  play.open_play();
  play.touched_by({red(3)});
  play.ball(1.2, 0.0);
  play.touched_by({blue(1)});
  play.ball(0.5, 0.0);
  play.touched_by({red(4)});
  EXPECT_EQ(play.figures(Team::red).passes, 0);
  EXPECT_EQ(play.figures(Team::blue).passes, 0);
}

TEST(Pass, IsNoneFromAContestedTouch) {
  RecordedMatch play;
  play.open_play();
  play.touched_by({red(3), blue(2)});
  play.ball(1.2, 0.0);
  play.touched_by({red(4)});
  EXPECT_EQ(play.figures(Team::red).passes, 0);
}

TEST(Pass, MayTakeThreeSecondsAndNotMore) {
  for (const auto& [wait_ms, passes] : {std::pair{2'950, 1}, std::pair{3'000, 0}}) {
    RecordedMatch play;
    play.open_play();
    play.touched_by({red(3)});
    play.ball(1.2, 0.0);
    play.run(wait_ms);
    play.touched_by({red(4)});
    EXPECT_EQ(play.figures(Team::red).passes, passes) << wait_ms;
  }
}

TEST(Pass, IsNoneThroughAStop) {
  RecordedMatch play;
  play.open_play();
  play.touched_by({blue(3)});
  play.ball(0.5, 2.4);
  play.step();  // out: corner or goal kick
  play.run_until_play();
  play.ball(-2.5, 0.0);
  play.touched_by({blue(4)});
  EXPECT_EQ(play.figures(Team::blue).passes, 0);
}

TEST(Touch, IsCountedAsItBegins) {
  RecordedMatch play = opened();
  play.touched_by({red(3)});
  play.touched_by({red(3)});
  play.step();
  play.touched_by({red(3)});
  EXPECT_EQ(play.figures().robots[red(3)].touches, 2);
}

}  // namespace
}  // namespace striker::sil
