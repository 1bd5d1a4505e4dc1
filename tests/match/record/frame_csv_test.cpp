// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/frame_csv.hpp"

#include <gtest/gtest.h>

#include "tests/match/record/scratch.hpp"

namespace striker::sil {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(stream, cell, ',');) {
    cells.push_back(cell);
  }
  return cells;
}

struct Table {
  explicit Table(const std::filesystem::path& file) {
    for (const std::string& line : lines_of(file)) {
      rows.push_back(cells_of(line));
    }
  }
  [[nodiscard]] std::string cell(std::size_t row, const std::string& column) const {
    const auto found = std::ranges::find(rows[0], column);
    return found == rows[0].end() ? "no column " + column
                                  : rows[row][static_cast<std::size_t>(found - rows[0].begin())];
  }
  [[nodiscard]] int number(std::size_t row, const std::string& column) const {
    return std::stoi(cell(row, column));
  }

  std::vector<std::vector<std::string>> rows;
};

Table table_of_short_match(const std::filesystem::path& file) {
  FrameCsv csv(file);
  RecordedMatch play({&csv}, short_rules());
  play_short_match(play);
  play.finish();
  return Table(file);
}

TEST(FrameCsv, HasThePublicDataSetsColumns) {
  const Scratch scratch;
  const Table table = table_of_short_match(scratch / "frames.csv");
  ASSERT_EQ(table.rows[0].size(), 57U);
  EXPECT_EQ(table.rows[0][5], "ball_pos_2");
  EXPECT_EQ(table.rows[0][6], "robot_0_wheel_speed_0");
  EXPECT_EQ(table.rows[0][15], "robot_4_wheel_speed_1");
  EXPECT_EQ(table.rows[0][16], "robot_0_cur_pos_0");
  EXPECT_EQ(table.rows[0][31], "robot_0_cur_pos_opp_0");
  EXPECT_EQ(table.rows[0][45], "robot_4_cur_pos_opp_2");
  EXPECT_EQ(table.rows[0][46], "robot_0_active");
  EXPECT_EQ(table.rows[0][55], "robot_4_active_opp");
  EXPECT_EQ(table.rows[0][56], "episode_id");
  for (const auto& row : table.rows) {
    ASSERT_EQ(row.size(), 57U);
  }
}

TEST(FrameCsv, TheFirstFrameIsThisLine) {
  const Scratch scratch;
  table_of_short_match(scratch / "frames.csv");
  EXPECT_EQ(lines_of(scratch / "frames.csv")[1],
            "21,1,3.0,0.600000,0.000000,0.050000,"
            "0.000000,0.000000,0.000000,0.000000,0.000000,0.000000,1.250000,-0.500000,0.000000,0.000000,"
            "-3.800000,0.000000,0.046000,-2.250000,1.000000,0.046000,-2.250000,-1.000000,0.046000,"
            "-0.900000,0.000000,0.046000,0.400000,0.000000,0.046000,"
            "3.800000,0.000000,0.046000,2.250000,-1.000000,0.046000,2.250000,1.000000,0.046000,"
            "0.650000,-0.300000,0.046000,0.650000,0.300000,0.046000,"
            "False,False,False,False,True,False,False,False,False,False,0");
}

TEST(FrameCsv, HasARowForEachFrameOfTheClockAndNoOther) {
  const Scratch scratch;
  FrameCsv csv(scratch / "frames.csv");
  RecordedMatch play({&csv}, short_rules());
  play_short_match(play);
  play.finish();
  const Table table(scratch / "frames.csv");
  EXPECT_EQ(table.rows.size() - 1, static_cast<std::size_t>(play.figures().played_ms() / frame_ms));
  EXPECT_EQ(play.figures().played_ms(), 2 * 10'000);
}

TEST(FrameCsv, AnEpisodeIsOneStateWithoutAGap) {
  const Scratch scratch;
  const Table table = table_of_short_match(scratch / "frames.csv");
  bool has_gap = false;
  for (std::size_t row = 2; row < table.rows.size(); ++row) {
    const bool is_gap = table.number(row, "frame") != table.number(row - 1, "frame") + 1;
    const bool goes_on = !is_gap && table.cell(row, "game_state") == table.cell(row - 1, "game_state");
    ASSERT_EQ(table.number(row, "episode_id") - table.number(row - 1, "episode_id"), goes_on ? 0 : 1);
    has_gap |= is_gap;
  }
  EXPECT_TRUE(has_gap);
}

TEST(FrameCsv, RedsFrameTurnsAtHalfTime) {
  const Scratch scratch;
  const Table table = table_of_short_match(scratch / "frames.csv");
  const std::size_t last = table.rows.size() - 1;
  for (const char* column : {"robot_0_cur_pos_0", "robot_2_cur_pos_0"}) {
    EXPECT_LT(std::stod(table.cell(1, column)), 0.0);
    EXPECT_LT(std::stod(table.cell(last, column)), 0.0);
  }
}

}  // namespace
}  // namespace striker::sil
