// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/kick_scenario.hpp"

#include <algorithm>
#include <exception>
#include <stdexcept>

#include "firmware/core/tick.hpp"

namespace striker::sil {

namespace {

constexpr std::uint32_t picture_ticks = core::decision_period_ticks;  // an AI Soccer frame
constexpr std::uint32_t clear_tick = 20;
constexpr std::uint32_t arm_tick = picture_ticks + 1;

}  // namespace

KickScenario::KickScenario(const KickPlan& plan, Seat& seat, std::span<Observer* const> observers)
    : plan_(plan),
      seat_(&seat),
      observers_(observers),
      world_(kick_world(seat.ticks_per_step() * tick_s, plan.place)) {
  look();
}

void KickScenario::run(const std::function<bool()>& stop) {
  try {
    play(stop);
  } catch (...) {
    for (Observer* observer : observers_) {
      try {
        observer->end_run();
      } catch (const std::exception&) {
        // Where the disk is full this file fails as well: the first fault is the one to tell.
      }
    }
    throw;
  }
  for (Observer* observer : observers_) {
    observer->end_run();
  }
}

void KickScenario::play(const std::function<bool()>& stop) {
  bool running = boot(stop);
  for (std::uint64_t i = 0; running && i < plan_.episodes; ++i) {
    running = play_episode(plan_.first_episode + i, stop);
  }
  moving_ = false;
  snapshot_.deciding = false;
  seat_->queue(operator_.order(can::Mode::disarm));
  run_tick();
}

// Returns false if it was stopped.
bool KickScenario::boot(const std::function<bool()>& stop) {
  while (tick_ < kick_boot_ticks) {
    if (tick_ % picture_ticks == 0) {
      seat_->take_picture(world_, tick_);
    }
    run_tick();
    if (stop() || operator_.controller_is_stopped()) {
      return false;
    }
  }
  if (plan_.needs_controller && !operator_.has_heard()) {
    throw std::runtime_error(
        "no controller said anything: start it on the same interface, with the same clock ('striker-firmware --can "
        "IFACE --clock realtime' for --realtime), or use --bus inproc");
  }
  return true;
}

// Returns false if it was stopped.
bool KickScenario::play_episode(std::uint64_t episode, const std::function<bool()>& stop) {
  const KickStart start = draw_kick(plan_.seed, episode, plan_.pose);
  snapshot_.episode = episode;
  moving_ = false;
  undecided_ticks_ = 0;
  longest_undecided_ticks_ = 0;
  seat_->reset();
  for (std::uint32_t episode_tick = 0; episode_tick < kick_episode_ticks; ++episode_tick) {
    place(episode_tick, start);
    snapshot_.deciding = episode_tick >= kick_first_decision_tick && episode_tick < kick_last_tick;
    snapshot_.contact = moving_ && episode_.outcome().contact;
    give_orders(episode_tick);
    take_picture(episode_tick, start);
    run_tick();
    if (stop() || operator_.controller_is_stopped()) {
      return false;
    }
  }
  outcomes_.push_back(episode_.outcome());
  if (longest_undecided_ticks_ > 3 * core::decision_period_ticks) {
    undriven_.push_back(episode);
  }
  for (Observer* observer : observers_) {
    observer->end_episode();
  }
  return true;
}

// Until decision 0 the scenario leads robot and ball; then they are the world's.
void KickScenario::place(std::uint32_t episode_tick, const KickStart& start) {
  if (episode_tick == 0) {
    world_.place_robot(0, start.robot);
  }
  if (episode_tick < kick_first_decision_tick) {
    world_.place_ball(ball_before(start, (kick_first_decision_tick - episode_tick) * tick_s));
    look();
  } else if (episode_tick == kick_first_decision_tick) {
    episode_.begin(world_, start);
    look();
    moving_ = true;
  } else if (episode_tick <= kick_last_tick && episode_tick % core::decision_period_ticks == 0) {
    episode_.end_decision();
  }
}

void KickScenario::give_orders(std::uint32_t episode_tick) {
  if (episode_tick == 0) {
    seat_->queue(operator_.order(can::Mode::disarm));
  } else if (episode_tick == clear_tick && operator_.controller_fault() != core::Fault::none) {
    seat_->queue(operator_.order(can::Mode::clear));
  } else if (episode_tick == arm_tick) {
    seat_->queue(operator_.order(can::Mode::arm));
  }
}

// A late picture is taken as much earlier, so that it comes with its decision. Until decision 0 it shows the ball where
// it was then; the robot stands.
void KickScenario::take_picture(std::uint32_t episode_tick, const KickStart& start) {
  const std::uint32_t latency_ticks = plan_.vision_latency_ticks;
  if (episode_tick <= kick_first_decision_tick && episode_tick % picture_ticks == 0) {
    const double ahead_s = (kick_first_decision_tick - episode_tick) * tick_s;
    world_.place_ball(ball_before(start, ahead_s + latency_ticks * tick_s));
    seat_->take_picture(world_, tick_);
    world_.place_ball(ball_before(start, ahead_s));
  }
  if (episode_tick + latency_ticks > kick_first_decision_tick &&
      (episode_tick + latency_ticks) % picture_ticks == 0) {
    seat_->take_picture(world_, tick_, latency_ticks);
  }
}

// One tick of the bus and the world, with what was queued for it.
void KickScenario::run_tick() {
  for (Observer* observer : observers_) {
    observer->begin_tick();
  }
  if (const auto confirmation = operator_.confirmation()) {
    seat_->queue(*confirmation);
  }
  seat_->begin_tick(tick_);
  seat_->end_tick(tick_);
  operator_.hear(seat_->answer());
  watch_decisions();
  if (moving_ && tick_ % seat_->ticks_per_step() == 0) {
    move_world();
  }
  show();
  ++tick_;
}

void KickScenario::watch_decisions() {
  const bool decided = operator_.decisions() != decisions_;
  decisions_ = operator_.decisions();
  undecided_ticks_ = decided || !snapshot_.deciding ? 0 : undecided_ticks_ + 1;
  longest_undecided_ticks_ = std::max(longest_undecided_ticks_, undecided_ticks_);
}

void KickScenario::move_world() {
  seat_->actuate(world_, tick_);
  episode_.step(world_);
  seat_->sense(world_);
  look();
}

// Reads the true world; to be called whenever it has changed.
void KickScenario::look() {
  robot_.pose = world_.robot_pose(seat_->robot());
  robot_.velocity_m_s = world_.robot_velocity_m_s(seat_->robot());
  snapshot_.ball = world_.ball();
}

void KickScenario::show() {
  robot_.frames = seat_->traffic();
  snapshot_.robots = std::span(&robot_, 1);
  snapshot_.tick = tick_;
  for (Observer* observer : observers_) {
    observer->end_tick(snapshot_);
  }
}

}  // namespace striker::sil
