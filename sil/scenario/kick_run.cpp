#include "sil/scenario/kick_run.hpp"

#include <fmt/core.h>

#include <utility>

namespace striker::sil {

namespace {

constexpr std::uint32_t boot_ticks = 50;
constexpr std::uint32_t picture_ticks = 50;  // an AI Soccer frame
constexpr std::uint32_t clear_tick = 20;
constexpr std::uint32_t arm_tick = 51;
constexpr std::uint32_t first_decision_tick = 100;
constexpr std::uint32_t last_tick = first_decision_tick + kick_decisions * picture_ticks;
constexpr std::uint32_t episode_ticks = last_tick + 100;

constexpr double tick_s = 0.001;

}  // namespace

KickRunner::KickRunner(const KickRunOptions& options, ControllerLink& link, KickRunHooks hooks)
    : options_(options),
      link_(&link),
      hooks_(std::move(hooks)),
      plant_(make_plant(options.plant, 0)),
      world_(kick_world(plant_->ticks_per_step() * tick_s)) {
  frames_.reserve(32);
}

void KickRunner::run() {
  bool running = boot();
  for (std::uint64_t i = 0; running && i < options_.episodes; ++i) {
    running = play_episode(options_.first_episode + i);
  }
  moving_ = false;
  record_.deciding = false;
  send_mode(can::Mode::disarm);
  run_tick();
}

bool KickRunner::boot() {
  bool running = true;
  while (running && tick_ < boot_ticks) {
    running = run_tick();
  }
  return running;
}

bool KickRunner::play_episode(std::uint64_t episode) {
  const KickStart start = draw_kick(options_.seed, episode, options_.pose);
  record_.episode = episode;
  moving_ = false;
  plant_->reset();
  for (std::uint32_t episode_tick = 0; episode_tick < episode_ticks; ++episode_tick) {
    prepare_tick(episode_tick, start);
    if (!run_tick()) {
      return false;
    }
  }
  outcomes_.push_back(episode_.outcome());
  if (hooks_.end_episode) {
    hooks_.end_episode(episode_.outcome());
  }
  return true;
}

void KickRunner::prepare_tick(std::uint32_t episode_tick, const KickStart& start) {
  if (episode_tick == first_decision_tick) {
    episode_.begin(world_, start);
    moving_ = true;
  } else if (moving_ && episode_tick <= last_tick && episode_tick % picture_ticks == 0) {
    episode_.end_decision();
  }
  record_.deciding = episode_tick >= first_decision_tick && episode_tick < last_tick;
  record_.contact = moving_ && episode_.outcome().contact;

  if (episode_tick == 0) {
    send_mode(can::Mode::disarm);
  } else if (episode_tick == clear_tick && controller_faulty_) {
    send_mode(can::Mode::clear);
  } else if (episode_tick == arm_tick) {
    send_mode(can::Mode::arm);
  }
  if (episode_tick % picture_ticks == 0) {
    if (moving_) {
      send_picture(world_.robot_pose(0), world_.ball().position_m);
    } else {
      send_picture(start.robot, ball_before(start, (first_decision_tick - episode_tick) * tick_s).position_m);
    }
  }
}

// One tick of the bus and the plant, with the frames that were prepared for it.
bool KickRunner::run_tick() {
  if (hooks_.begin_tick) {
    hooks_.begin_tick();
  }
  if (tick_ != 0) {
    frames_.push_back(drives_.state_frame(plant_->measured(), tick_));
  }
  if (options_.lockstep) {
    frames_.push_back(can::send(can::Sync{.tick = static_cast<std::int32_t>(tick_)}, sync_counter_));
  }
  link_->exchange(tick_, frames_, answer_);
  take_answer();
  frames_.insert(frames_.end(), answer_.begin(), answer_.end());
  answer_.clear();
  if (moving_ && tick_ % plant_->ticks_per_step() == 0) {
    plant_->actuate(world_, drives_.command(), drives_.cut(tick_));
    episode_.step(world_);
    plant_->sense(world_);
  }
  if (hooks_.end_tick) {
    record_.tick = tick_;
    record_.frames = &frames_;
    hooks_.end_tick(record_);
  }
  frames_.clear();
  ++tick_;
  return !hooks_.stop || !hooks_.stop();
}

void KickRunner::take_answer() {
  for (const can::Frame& frame : answer_) {
    drives_.take(frame, tick_);
    if (can::is<can::Status>(frame)) {
      can::Status status;
      can::ReceiveCounter any;
      if (can::receive(frame, any, status) == can::Verdict::accepted) {
        controller_faulty_ = status.state == static_cast<std::int32_t>(can::State::fault);
      }
    } else if (can::is<can::Version>(frame)) {
      can::Version version;
      if (can::unpack(frame, version) == can::Verdict::accepted) {
        policy_ = fmt::format("{:04x}{:04x}", version.policy_high, version.policy_low);
      }
    }
  }
}

void KickRunner::send_mode(can::Mode mode) {
  frames_.push_back(can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode)}, mode_counter_));
}

void KickRunner::send_picture(const Pose& robot, Vec2 ball_m) {
  const auto pair = vision_.picture(robot, ball_m);
  frames_.insert(frames_.end(), pair.begin(), pair.end());
}

}  // namespace striker::sil
