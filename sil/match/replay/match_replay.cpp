// SPDX-License-Identifier: Apache-2.0
#include "sil/match/replay/match_replay.hpp"

#include <cmath>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/host/can/candump_line.hpp"
#include "sil/match/play/order_sender.hpp"
#include "sil/match/replay/bus_logs.hpp"
#include "sil/record/candump_text.hpp"

namespace striker::sil {

namespace {

// Gives the orders that a team gave in a recorded match, in their frames.
class RecordedTeam final : public Strategy {
 public:
  RecordedTeam(const std::filesystem::path& buses, Team team) : team_(team) {
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      logs_.push_back(std::make_unique<BusLogReader>(bus_log_file(buses, robot_of(team, id))));
    }
  }

  [[nodiscard]] TeamOrders play(const TeamView& view) override {
    const bool is_turned = (team_ == Team::red) != (view.half == 1);
    TeamOrders orders;
    for (std::size_t id = 0; id < robots_a_team; ++id) {
      orders[id] = order_at(*logs_[id], view.sim_ms * us_a_ms);
      if (auto* motion = orders[id] ? std::get_if<MotionOrder>(&*orders[id]) : nullptr; motion && is_turned) {
        motion->target = turned(motion->target);
      }
    }
    return orders;
  }

 private:
  static constexpr std::int64_t us_a_ms = 1000;

  // Reads up to the end of this frame's first tick.
  std::optional<RobotOrder> order_at(BusLogReader& log, std::int64_t stamp_us) {
    std::optional<RobotOrder> order;
    for (;;) {
      const std::string text = log.next().value_or("");
      const auto parsed = host::parse_candump_line(text);
      const auto* line = std::get_if<host::CandumpLine>(&parsed);
      if (line == nullptr || line->stamp_us > stamp_us) {
        return order;  // nothing of another frame's first tick is lost: this line is of its second
      }
      if (line->stamp_us == stamp_us && !order) {
        order = order_in(line->frame);
      }
    }
  }

  Team team_;
  std::vector<std::unique_ptr<BusLogReader>> logs_;
};

class BusComparison final : public Observer {
 public:
  explicit BusComparison(const std::filesystem::path& buses) {
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      logs_.push_back(std::make_unique<BusLogReader>(bus_log_file(buses, robot)));
    }
  }

  void end_tick(const Snapshot& snapshot) override {
    for (std::size_t robot = 0; !difference_ && robot < robots_in_match; ++robot) {
      for (const StampedFrame& frame : snapshot.robots[robot].frames) {
        compare(snapshot.tick, robot, frame);
      }
    }
  }
  void end_run() override {
    for (std::size_t robot = 0; !difference_ && robot < robots_in_match; ++robot) {
      if (const auto line = logs_[robot]->next()) {
        difference_ = {.tick = tick_, .robot = robot, .recorded = "'" + *line + "'", .now = {}};
      }
    }
  }

  [[nodiscard]] const std::optional<ReplayDifference>& difference() const { return difference_; }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }

 private:
  void compare(std::uint32_t tick, std::size_t robot, const StampedFrame& frame) {
    tick_ = tick;
    if (difference_) {
      return;
    }
    CandumpText text;
    append_line(text, robot, frame);
    const std::string_view now(text.data(), text.size() - 1);
    const auto recorded = logs_[robot]->next();
    if (now != recorded) {
      difference_ = {
          .tick = tick, .robot = robot, .recorded = recorded.value_or(""), .now = std::string(now)};
    } else {
      ++frames_;
    }
  }

  std::uint32_t tick_ = 0;
  std::vector<std::unique_ptr<BusLogReader>> logs_;
  std::optional<ReplayDifference> difference_;
  std::uint64_t frames_ = 0;
};

}  // namespace

MatchReplay replay_match(const MatchPlan& plan, std::int64_t frames, const std::filesystem::path& buses,
                         const MatchLinks& links, std::span<MatchObserver* const> records,
                         const std::function<bool()>& stop) {
  RecordedTeam red(buses, Team::red);
  RecordedTeam blue(buses, Team::blue);
  BusComparison comparison(buses);
  std::array<Observer*, 1> observers = {&comparison};
  MatchParts parts{.teams = {&red, &blue}, .links = {}, .records = records, .buses = observers};
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    parts.links[robot] = links[robot].get();
  }
  MatchRun run(plan, parts);
  const MatchEnd end = run.run([&] {
    return comparison.difference() || std::llround(run.simulated_s() * 1e3) >= frames * frame_ms || stop();
  });
  return {.difference = comparison.difference(), .frames = comparison.frames(), .end = end};
}

}  // namespace striker::sil
