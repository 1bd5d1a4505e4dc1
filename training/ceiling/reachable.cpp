// SPDX-License-Identifier: Apache-2.0
#include "training/ceiling/reachable.hpp"

#include <algorithm>

namespace striker::training {

std::size_t LineGrid::rows() const {
  return static_cast<std::size_t>(2.0 * farthest_m() / position_cell_m) + 2;
}

std::size_t LineGrid::columns() const {
  return static_cast<std::size_t>(2.0 * top_speed_m_s() / speed_cell_m_s) + 2;
}

std::size_t LineGrid::row(double position_m) const {
  const double end_m = farthest_m();
  const double kept_m = std::clamp(position_m, -end_m, end_m);
  return static_cast<std::size_t>((kept_m + end_m) / position_cell_m);
}

std::size_t LineGrid::cell(const LineState& state) const {
  const auto column = static_cast<std::size_t>((state.speed_m_s + top_speed_m_s()) / speed_cell_m_s);
  return row(state.position_m) * columns() + column;
}

Reachable::Reachable(const LineGrid& grid)
    : grid_(grid), drive_(line_drive(grid.robot)), levels_(sil::kick_decisions) {
  CellTable cells(grid);
  levels_[0].push_back({});
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    const std::vector<LineNode>& before = levels_[level - 1];
    std::vector<LineNode>& now = levels_[level];
    cells.clear();
    for (std::uint32_t parent = 0; parent < before.size(); ++parent) {
      for (std::size_t action = 0; action < drive_.set_points_m_s.size(); ++action) {
        LineNode node{
            .state = before[parent].state, .parent = parent, .action = static_cast<std::uint8_t>(action)};
        for (int i = 0; i < steps_per_decision; ++i) {
          advance(node.state, drive_.set_points_m_s[action], drive_.gain_limit_m_s);
        }
        const auto next = static_cast<std::uint32_t>(now.size());
        if (cells.find_or_put(grid.cell(node.state), next) == next) {
          now.push_back(node);
        }
      }
    }
    std::stable_sort(now.begin(), now.end(), [&](const LineNode& a, const LineNode& b) {
      return grid.row(a.state.position_m) < grid.row(b.state.position_m);
    });
  }
}

std::span<const LineNode> Reachable::between(int decision, double low_m, double high_m) const {
  const auto all = level(decision);
  const auto row_of = [this](const LineNode& node) { return grid_.row(node.state.position_m); };
  const auto first = std::ranges::lower_bound(all, grid_.row(low_m), {}, row_of);
  const auto end = std::ranges::upper_bound(all, grid_.row(high_m), {}, row_of);
  return first < end ? std::span(first, end) : std::span<const LineNode>{};
}

void Reachable::actions_to(int decision, std::size_t node, std::span<std::uint8_t> actions) const {
  for (; decision > 0; --decision) {
    const LineNode& at = level(decision)[node];
    actions[static_cast<std::size_t>(decision - 1)] = at.action;
    node = at.parent;
  }
}

}  // namespace striker::training
