// SPDX-License-Identifier: Apache-2.0
// The run's side of the live view: an observer that hands its state over (exchange.hpp), and before each tick does what
// viewers asked for. One that only watches changes nothing that a run writes.
//
// Time: a pause stops before the next tick, and looks for commands every millisecond. A step lets so many ticks pass. In a run
// on the wall clock time cannot be stopped, and such commands are refused with a note.
// An emergency stop is an operator's frame on the robot's bus with the next tick's frames, and ends a pause: it goes out at
// once, and before a pause that somebody presses right after it. It is sent again every 10 ms until the controller says that
// it is stopped, as one that is off the bus hears none. A fault is a live one on the robot's link (fault/live_faults.hpp). A
// restart ends the run; whoever played it begins it anew with `restart_seed`.
//
//   LiveView view(exchange, {.speed = 1.0, .has_time = true, .stop = host::stop_requested});
//   view.begin_run({.seed = 7, .robots = 1, .say = ..., .faults = ...});
//   scenario.run([&] { return host::stop_requested() || view.restart_seed(); });
//
// Cost: per tick and robot a count and a copy of 12 bytes for each frame; a copy of the state (19 KB) when it is asked for.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "firmware/host/periodic_clock.hpp"
#include "sil/fault/live_faults.hpp"
#include "sil/match/record/match_frame.hpp"
#include "sil/record/observer.hpp"
#include "sil/view/exchange.hpp"
#include "sil/view/time_gate.hpp"

namespace striker::sil {

struct LiveViewPlan {
  double speed = 1.0;                                 // times real time; 0: as fast as it goes
  bool has_time = true;                               // false: the wall clock has it
  std::function<bool()> stop = [] { return false; };  // asked while it waits
};

// What a run has for its viewers. All of it outlives the run.
struct LiveRun {
  std::uint64_t seed = 0;
  std::size_t robots = 1;
  // Onto this robot's bus with the next tick.
  std::function<void(std::size_t robot, const can::Frame& frame)> say;
  std::array<LiveFaults*, most_viewed_robots> faults = {};  // of each robot's link
  std::array<const InProcessLink*, most_viewed_robots> controllers =
      {};  // with the built-in policy, or nothing
};

class LiveView final : public Observer, public MatchObserver {
 public:
  // The exchange outlives it.
  LiveView(ViewExchange& exchange, LiveViewPlan plan);

  void begin_run(LiveRun run);
  // A viewer asked for another run with this seed.
  [[nodiscard]] std::optional<std::uint64_t> restart_seed() const { return restart_seed_; }

  void begin_tick() override;
  void end_tick(const Snapshot& snapshot) override;
  void end_run() override { show(); }
  void frame(const MatchFrame& frame) override;

 private:
  void obey();
  void obey(const ViewCommand& command);
  [[nodiscard]] bool may_pass() const;
  [[nodiscard]] bool is_due(const std::optional<std::uint32_t>& stop) const {
    return stop && *stop <= state_.tick;
  }
  void press_stop(std::optional<std::size_t> robot);
  void send_stops();
  void begin_fault(const ViewCommand& command);
  void note(std::string_view text);
  void tally(std::size_t robot, const RobotSnapshot& seen, bool with_wheels);
  void watch_episode(const Snapshot& snapshot);
  void show();

  ViewExchange* exchange_;
  LiveViewPlan plan_;
  host::MonotonicClock clock_;
  TimeGate gate_;
  LiveRun run_;
  LiveState state_;
  std::array<std::optional<std::uint32_t>, most_viewed_robots> stop_due_ =
      {};  // from this tick on, where one was pressed
  std::optional<std::uint64_t> restart_seed_;
};

}  // namespace striker::sil
