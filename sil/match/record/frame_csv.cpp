// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/frame_csv.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>
#include <string>

#include "sil/world/physics_constants.hpp"

namespace striker::sil {
namespace {

using Row = fmt::basic_memory_buffer<char, 1024>;

// To the micrometre; a place that was turned round is never -0.
void add(Row& row, double value) {
  fmt::format_to(fmt::appender(row), FMT_COMPILE(",{:.6f}"), value + 0.0);
}

void add_poses(Row& row, const std::array<RobotView, robots_a_team>& robots,
               std::span<const RobotRecord> records) {
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    add(row, robots[id].pose.x_m);
    add(row, robots[id].pose.y_m);
    add(row, records[id].height_m);
  }
}

void add_flags(Row& row, const std::array<RobotView, robots_a_team>& robots) {
  for (const RobotView& robot : robots) {
    row.append(std::string_view(robot.active ? ",True" : ",False"));
  }
}

std::string column_names() {
  std::string names = "frame,game_state,friction,ball_pos_0,ball_pos_1,ball_pos_2";
  const auto add_group = [&names](std::string_view group, int parts) {
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      for (int part = 0; part < parts; ++part) {
        names += fmt::format(",robot_{}_{}_{}", id, group, part);
      }
    }
  };
  add_group("wheel_speed", 2);
  add_group("cur_pos", 3);
  add_group("cur_pos_opp", 3);
  for (const std::string_view group : {"active", "active_opp"}) {
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      names += fmt::format(",robot_{}_{}", id, group);
    }
  }
  return names + ",episode_id\n";
}

}  // namespace

void FrameCsv::begin(const MatchHeader& /*header*/) {
  file_.write(column_names());
}

void FrameCsv::frame(const MatchFrame& frame) {
  if (told_.state != GameState::pause && told_.state != GameState::over) {
    write_row(frame, view_of(Team::red, frame.seen, told_));
  }
  told_.half = frame.ruling.half;
  told_.state = frame.ruling.state;
  told_.locked = frame.ruling.locked;
  told_.sent_out = frame.ruling.sent_out;
}

void FrameCsv::write_row(const MatchFrame& frame, const TeamView& view) {
  if (frame.number != last_frame_ + 1 || view.state != last_state_) {
    ++episode_;
  }
  last_frame_ = frame.number;
  last_state_ = view.state;

  Row row;
  fmt::format_to(fmt::appender(row), FMT_COMPILE("{},{},{:.1f}"), frame.number, static_cast<int>(view.state),
                 tyre_friction);
  add(row, view.ball_m.x);
  add(row, view.ball_m.y);
  add(row, view.ball_height_m);
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    for (const double set_point_m_s : frame.robots[robot_of(Team::red, id)].set_points_m_s) {
      add(row, set_point_m_s);
    }
  }
  add_poses(row, view.own, frame.robots.first<robots_a_team>());
  add_poses(row, view.opponents, frame.robots.last<robots_a_team>());
  add_flags(row, view.own);
  add_flags(row, view.opponents);
  fmt::format_to(fmt::appender(row), FMT_COMPILE(",{}\n"), episode_);
  file_.write({row.data(), row.size()});
}

}  // namespace striker::sil
