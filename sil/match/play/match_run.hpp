// SPDX-License-Identifier: Apache-2.0
// A whole AI Soccer match: ten robots on ten buses in one world, two strategies, a referee. One tick of 1 ms at a time;
// every 50 ticks a frame:
//
//   what is seen -> what the teams answer (if the clock runs) -> the referee's ruling -> placements
//     -> pictures and orders on every robot's bus -> 50 ticks of buses, drives and world
//
// What a strategy is shown, it is shown with the ruling of the frame before, and its orders count if the referee lets
// the robot move by this frame's; so in the first frame after a pause all orders are 0. A robot that may not move is
// told 0 by the referee. In a pause all are disarmed, from the placement on armed again. A robot that was sent out is
// taken off the field.
//
// Same plan, strategies and answers of the controllers: the same to the bit.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sil/bus/controller_link.hpp"
#include "sil/match/play/match_robot.hpp"
#include "sil/match/record/match_frame.hpp"
#include "sil/match/referee/referee.hpp"
#include "sil/match/team/strategy.hpp"
#include "sil/record/observer.hpp"
#include "sil/robot/plant.hpp"
#include "sil/world/random.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

struct MatchPlan {
  MatchHeader header;  // teams, seed, rules, slip, jitter
  PlantKind plant = PlantKind::servo;
  std::array<std::vector<TimedFault>, robots_in_match> faults = {};  // of each robot
};

// All of them outlive the run. A link a robot, in the match's order.
struct MatchParts {
  std::array<Strategy*, 2> teams = {};  // red, blue
  std::array<ControllerLink*, robots_in_match> links = {};
  std::span<MatchObserver* const> records = {};
  std::span<Observer* const> buses = {};  // see every tick with all ten buses
};

class MatchRun {
 public:
  MatchRun(const MatchPlan& plan, const MatchParts& parts);

  // Until the match is over, or `stop`, which is asked after every frame, says so: then it is incomplete, and the first
  // tick after that frame is the last one, so that its orders are on the buses. Throws what a link, strategy or record
  // throws.
  MatchEnd run(const std::function<bool()>& stop);

  // The same, a frame at a time and without records' begin and end, for who answers from outside: begin(); then, until
  // the match is over, see_frame(), in which time passes, and end_frame(), which asks the teams and has the referee rule.
  void begin();
  void see_frame();
  void end_frame();
  // Sent on this robot's bus with the next tick's frames: what somebody beside its operator and its team says.
  void say(std::size_t robot, const can::Frame& frame) { robots_[robot]->queue(frame); }
  // What a team is shown of the frame that was seen last.
  [[nodiscard]] TeamView view(Team team) const;

  [[nodiscard]] const Ruling& ruling() const { return referee_.ruling(); }
  [[nodiscard]] double simulated_s() const { return tick_ * tick_s; }

 private:
  [[nodiscard]] RefereeFrame look() const;
  [[nodiscard]] std::array<std::optional<TeamOrders>, 2> ask_teams();
  void follow(const Ruling& ruling);
  void place(std::size_t robot, const Pose& pose, bool with_jitter);
  void tell(const Ruling& ruling, const std::array<std::optional<TeamOrders>, 2>& orders);
  void show_frame(const RefereeFrame& seen, const std::array<std::optional<TeamOrders>, 2>& orders);
  void run_frame();
  void run_tick();
  void move_world();
  void show_tick();

  MatchPlan plan_;
  MatchParts parts_;
  World world_;
  Referee referee_;
  Random jitter_;
  std::vector<std::unique_ptr<MatchRobot>> robots_;

  std::uint32_t tick_ = 0;
  std::int64_t frame_ = 0;
  RefereeFrame seen_;
  bool settles_ = false;  // in a pause: the placement is done
  RobotSet on_field_ = RobotSet().set();
  RobotSet touched_before_;  // in the frame before: what a player is told
  std::array<RobotSnapshot, robots_in_match> snapshots_ = {};
};

}  // namespace striker::sil
