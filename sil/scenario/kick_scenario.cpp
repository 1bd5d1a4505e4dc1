// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/kick_scenario.hpp"

#include <algorithm>
#include <exception>
#include <stdexcept>

#include "firmware/core/tick.hpp"

namespace striker::sil {

namespace {

constexpr std::uint32_t second_ticks = 1'000;
constexpr std::uint32_t clear_tick = 20;

// How long before the picture of decision 0 another one is taken, some pictures back.
std::uint32_t ticks_back(const KickPlan& plan, std::uint32_t pictures) {
  return pictures * second_ticks / plan.camera_rate_Hz;
}

// Four pictures, and the controller believes its camera.
std::uint32_t boot_ticks_of(const KickPlan& plan) {
  return std::max(kick_boot_ticks, ticks_back(plan, 4));
}

// Late enough for all pictures that tell a motion, and that of decision 0.
std::uint32_t first_decision_tick_of(const KickPlan& plan) {
  return std::max(kick_first_decision_tick, ticks_back(plan, plan.pictures_a_motion + 1));
}

}  // namespace

KickScenario::KickScenario(const KickPlan& plan, Seat& seat, std::span<Observer* const> observers)
    : plan_(plan),
      seat_(&seat),
      observers_(observers),
      world_(kick_world(seat.ticks_per_step() * tick_s, plan.place)),
      first_decision_tick_(first_decision_tick_of(plan)),
      arm_tick_(first_decision_tick_ - ticks_back(plan, 1) + 1),
      episode_({.reward = plan.reward}) {
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

std::uint32_t KickScenario::last_tick() const {
  return first_decision_tick_ + (kick_last_tick - kick_first_decision_tick);
}

// In this tick, if there is one in `with_tick`; that may be up to a second later.
bool KickScenario::picture_is_due(std::uint32_t tick, std::uint32_t with_tick) const {
  const std::uint32_t since_ticks = tick + second_ticks - with_tick;
  return since_ticks * plan_.camera_rate_Hz / second_ticks !=
         (since_ticks - 1) * plan_.camera_rate_Hz / second_ticks;
}

// Returns false if it was stopped.
bool KickScenario::boot(const std::function<bool()>& stop) {
  while (tick_ < boot_ticks_of(plan_)) {
    if (picture_is_due(tick_, 0)) {
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
  for (std::uint32_t episode_tick = 0; episode_tick < last_tick() + ticks_to_see_it_leave; ++episode_tick) {
    place(episode_tick, start);
    snapshot_.deciding = episode_tick >= first_decision_tick_ && episode_tick < last_tick();
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
  if (episode_tick < first_decision_tick_) {
    world_.place_ball(ball_before(start, (first_decision_tick_ - episode_tick) * tick_s));
    look();
  } else if (episode_tick == first_decision_tick_) {
    episode_.begin(world_, start);
    look();
    moving_ = true;
  } else if (episode_tick <= last_tick() &&
             (episode_tick - first_decision_tick_) % core::decision_period_ticks == 0) {
    episode_.end_decision();
  }
}

void KickScenario::give_orders(std::uint32_t episode_tick) {
  if (episode_tick == 0) {
    seat_->queue(operator_.order(can::Mode::disarm));
  } else if (episode_tick == clear_tick && operator_.controller_fault() != core::Fault::none) {
    seat_->queue(operator_.order(can::Mode::clear));
  } else if (episode_tick == arm_tick_) {
    seat_->queue(operator_.order(can::Mode::arm));
  }
}

// A late picture is taken as much earlier, so that it comes with its decision. Until decision 0 it shows the ball where
// it was then; the robot stands.
void KickScenario::take_picture(std::uint32_t episode_tick, const KickStart& start) {
  const std::uint32_t latency_ticks = plan_.vision_latency_ticks;
  if (episode_tick <= first_decision_tick_ && picture_is_due(episode_tick, first_decision_tick_)) {
    const double ahead_s = (first_decision_tick_ - episode_tick) * tick_s;
    world_.place_ball(ball_before(start, ahead_s + latency_ticks * tick_s));
    seat_->take_picture(world_, tick_);
    world_.place_ball(ball_before(start, ahead_s));
  }
  if (episode_tick + latency_ticks > first_decision_tick_ &&
      picture_is_due(episode_tick + latency_ticks, first_decision_tick_)) {
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
