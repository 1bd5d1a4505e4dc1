// SPDX-License-Identifier: Apache-2.0
// Where the robot can be: all states on its line (line_play.hpp) that 3 actions in 40 decisions reach from
// rest, merged on a grid of position and speed. Each cell keeps the first real state that fell into it, and
// how that came about, so that every node is a state of an action sequence that exists. The ball plays no
// part: one set serves all episodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "training/line/line_play.hpp"

namespace striker::training {

// Whose states are merged, and how finely.
struct LineGrid {
  double position_cell_m = 0.005;
  double speed_cell_m_s = 0.02;
  core::RobotDescription robot = core::forward;

  // The robot cannot go farther, nor faster.
  [[nodiscard]] double top_speed_m_s() const { return sil::spec_of(robot).max_rim_speed_m_s; }
  [[nodiscard]] double farthest_m() const {
    return top_speed_m_s() * sil::kick_decisions * sil::decision_period_s;
  }

  [[nodiscard]] std::size_t rows() const;     // of positions
  [[nodiscard]] std::size_t columns() const;  // of speeds
  [[nodiscard]] std::size_t row(double position_m) const;
  [[nodiscard]] std::size_t cell(const LineState& state) const;  // row by row
};

// Which node of a level each cell holds. Cleared at constant cost.
class CellTable {
 public:
  explicit CellTable(const LineGrid& grid) : entries_(grid.rows() * grid.columns()) {}

  void clear() { ++round_; }
  // The node in this cell; `node` if it was empty, which it then holds.
  std::uint32_t find_or_put(std::size_t cell, std::uint32_t node) {
    Entry& entry = entries_[cell];
    if (entry.round != round_) {
      entry = {.round = round_, .node = node};
    }
    return entry.node;
  }

 private:
  struct Entry {
    std::uint32_t round = 0;
    std::uint32_t node = 0;
  };
  std::vector<Entry> entries_;
  std::uint32_t round_ = 1;
};

struct LineNode {
  LineState state;
  std::uint32_t parent = 0;  // in the level before
  std::uint8_t action = 0;   // of the decision that led here
};

class Reachable {
 public:
  explicit Reachable(const LineGrid& grid);

  [[nodiscard]] const LineGrid& grid() const { return grid_; }
  [[nodiscard]] const LineDrive& drive() const { return drive_; }
  // The nodes that the robot can be in before this decision (0 to 39), sorted by rows of the grid.
  [[nodiscard]] std::span<const LineNode> level(int decision) const {
    return levels_[static_cast<std::size_t>(decision)];
  }
  // The nodes of that level which lie in the rows of these positions, their ends included.
  [[nodiscard]] std::span<const LineNode> between(int decision, double low_m, double high_m) const;
  // Writes the actions that lead to a node of a level into the first `decision` places.
  void actions_to(int decision, std::size_t node, std::span<std::uint8_t> actions) const;

 private:
  LineGrid grid_;
  LineDrive drive_;
  std::vector<std::vector<LineNode>> levels_;
};

}  // namespace striker::training
