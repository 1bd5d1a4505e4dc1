// SPDX-License-Identifier: Apache-2.0
// Plays kick episodes with one seat, one tick of 1 ms at a time: the operator's orders, when a picture is
// taken, and when the world moves.
//
// An episode takes 2,200 ticks: disarm and the first picture; 50 ticks later the second, then arm; 50 later
// the third, which is decision 0 and starts the ball; 40 decisions; 100 ticks to see the ball leave. A faster camera
// shows more in the same time; a slower one gets the time for as many pictures as tell a motion, and one more. Arming
// always comes after the last of them before decision 0, so that no other picture is decision 0. Until
// then the robot is held and the ball led along its path. A latched fault is cleared before arming.
// Arming and clearing take two steps: the controller's challenge is confirmed in the tick after it came. An emergency
// stop is never cleared: it ends the run. The boot takes 200 ticks, or four pictures, until the controller believes its
// camera; tick 0 is SYNC and a picture.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/tick.hpp"
#include "sil/record/observer.hpp"
#include "sil/robot/seat.hpp"
#include "sil/scenario/operator.hpp"
#include "sil/task/kick_task.hpp"

namespace striker::sil {

// Of the run, then of an episode with the official camera.
inline constexpr std::uint32_t kick_boot_ticks = 200;
inline constexpr std::uint32_t kick_first_decision_tick = 2 * core::decision_period_ticks;
inline constexpr std::uint32_t kick_last_tick =
    kick_first_decision_tick + kick_decisions * core::decision_period_ticks;
inline constexpr std::uint32_t ticks_to_see_it_leave = 100;
inline constexpr std::uint32_t kick_episode_ticks = kick_last_tick + ticks_to_see_it_leave;

struct KickPlan {
  PoseMode pose = PoseMode::origin;
  std::uint64_t seed = 1;
  std::uint64_t first_episode = 0;
  std::uint64_t episodes = 20;
  KickReward reward = KickReward::contact;
  KickPlace place = {};                    // with another robot or ball than the official ones
  std::uint32_t vision_latency_ticks = 0;  // at most a decision: pictures are taken so much before they come
  // Pictures come in the ticks that reach n / rate, one of them with decision 0.
  std::uint32_t camera_rate_Hz = 20;
  std::uint32_t pictures_a_motion = 1;  // before the controller knows one (robot_profile.hpp)
  bool needs_controller = false;  // one that says nothing during the boot is an error, as on a wall clock
};

class KickScenario {
 public:
  // Makes the world that the seat's robot, number 0, stands in. Seat and observers outlive it.
  KickScenario(const KickPlan& plan, Seat& seat, std::span<Observer* const> observers);

  // All episodes, or those that were completed before `stop`, which is asked after every tick; leaves the
  // controller disarmed. Throws std::runtime_error where the bus fails, or a needed controller said nothing until the
  // end of the boot; the observers' files are completed all the same.
  void run(const std::function<bool()>& stop);

  [[nodiscard]] const std::vector<KickOutcome>& outcomes() const { return outcomes_; }
  // The numbers of the completed episodes that no controller drove all along: somewhere between the first decision
  // and the last none came for three periods, as nobody was there, or armed.
  [[nodiscard]] const std::vector<std::uint64_t>& undriven() const { return undriven_; }
  [[nodiscard]] double simulated_s() const { return tick_ * tick_s; }
  [[nodiscard]] const std::string& policy() const { return operator_.policy(); }

  // Why the run ended before its last episode, if it was not `stop`.
  [[nodiscard]] bool ended_by_emergency_stop() const { return operator_.controller_is_stopped(); }

 private:
  void play(const std::function<bool()>& stop);
  [[nodiscard]] std::uint32_t last_tick() const;
  [[nodiscard]] bool picture_is_due(std::uint32_t tick, std::uint32_t with_tick) const;
  bool boot(const std::function<bool()>& stop);
  bool play_episode(std::uint64_t episode, const std::function<bool()>& stop);
  void place(std::uint32_t episode_tick, const KickStart& start);
  void give_orders(std::uint32_t episode_tick);
  void take_picture(std::uint32_t episode_tick, const KickStart& start);
  void run_tick();
  void watch_decisions();
  void move_world();
  void look();
  void show();

  KickPlan plan_;
  Seat* seat_;
  std::span<Observer* const> observers_;
  World world_;
  Operator operator_;
  std::uint32_t first_decision_tick_;  // of an episode
  std::uint32_t arm_tick_;

  std::uint32_t tick_ = 0;
  KickEpisode episode_;
  bool moving_ = false;  // the world runs
  RobotSnapshot robot_;
  Snapshot snapshot_;
  std::vector<KickOutcome> outcomes_;
  std::vector<std::uint64_t> undriven_;
  std::uint64_t decisions_ = 0;  // of the controller, so far
  std::uint32_t undecided_ticks_ = 0;
  std::uint32_t longest_undecided_ticks_ = 0;  // of the episode
};

}  // namespace striker::sil
