// SPDX-License-Identifier: Apache-2.0
#include "sil/view/live_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "firmware/can/codec.hpp"
#include "sil/scenario/operator.hpp"

namespace striker::sil {

namespace {

constexpr std::size_t identifiers = 0x800;

// The place of each identifier in the message table.
constexpr auto kind_of_identifier = [] {
  std::array<std::uint8_t, identifiers> kinds{};
  kinds.fill(message_kinds);
  std::uint8_t kind = 0;
  can::for_each_layout([&](const auto& message) { kinds[message.info.id] = kind++; });
  return kinds;
}();

constexpr std::size_t wheel_command = kind_of_identifier[can::layout<can::WheelCommand>.info.id];
constexpr std::size_t wheel_state = kind_of_identifier[can::layout<can::WheelState>.info.id];

bool stops_time(ViewAction action) {
  return action == ViewAction::pause || action == ViewAction::run || action == ViewAction::step ||
         action == ViewAction::speed;
}

// By the controller's own words, as an operator hears them.
bool is_stopped(const LiveRobot& robot) {
  can::Status status;
  can::Safety safety;
  const can::Frame& of_status = robot.messages[kind_of_identifier[can::layout<can::Status>.info.id]].last;
  const can::Frame& of_safety = robot.messages[kind_of_identifier[can::layout<can::Safety>.info.id]].last;
  const auto stop = core::Fault::emergency_stop;
  return (can::receive(of_status, status) == can::Verdict::accepted &&
          status.fault == static_cast<std::int32_t>(stop)) ||
         (can::receive(of_safety, safety) == can::Verdict::accepted &&
          (static_cast<core::Faults>(safety.faults) & core::set_of(stop)) != 0);
}

}  // namespace

LiveView::LiveView(ViewExchange& exchange, LiveViewPlan plan)
    : exchange_(&exchange), plan_(std::move(plan)), gate_(clock_, plan_.has_time ? plan_.speed : 0.0) {}

void LiveView::begin_run(LiveRun run) {
  run_ = std::move(run);
  restart_seed_.reset();
  stop_due_ = {};
  state_ =
      LiveState{.run = state_.run + 1, .seed = run_.seed, .robot_count = run_.robots, .note = state_.note};
}

void LiveView::begin_tick() {
  obey();
  if (!may_pass()) {
    show();
  }
  while (!may_pass() && !restart_seed_ && !plan_.stop()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    obey();
    if (exchange_->wanted.load(std::memory_order_relaxed)) {
      show();
    }
  }
  if (gate_.is_open()) {
    gate_.pace();
  }
  send_stops();
}

// In a pause too, where a stop was pressed before it that is not out yet.
bool LiveView::may_pass() const {
  return gate_.is_open() || std::ranges::any_of(stop_due_, [&](const auto& due) { return is_due(due); });
}

void LiveView::end_tick(const Snapshot& snapshot) {
  state_.tick = snapshot.tick;
  state_.episode = snapshot.episode;
  state_.ball = snapshot.ball;
  const bool with_wheels = snapshot.tick % ticks_a_wheel_sample == 0;
  const std::size_t robots = std::min(snapshot.robots.size(), most_viewed_robots);
  for (std::size_t robot = 0; robot < robots; ++robot) {
    tally(robot, snapshot.robots[robot], with_wheels);
  }
  watch_episode(snapshot);
  if (exchange_->wanted.load(std::memory_order_relaxed)) {
    show();
  }
}

void LiveView::frame(const MatchFrame& frame) {
  const Ruling& ruling = frame.ruling;
  state_.match = LiveMatch{.score = ruling.score,
                           .half = ruling.half,
                           .clock_ms = ruling.clock_ms,
                           .state = ruling.state,
                           .owner = ruling.owner,
                           .touching = frame.seen.touching,
                           .sent_out = ruling.sent_out};
}

void LiveView::obey() {
  while (const auto command = exchange_->commands.take()) {
    obey(*command);
  }
}

void LiveView::obey(const ViewCommand& command) {
  if (stops_time(command.action) && !plan_.has_time) {
    note("the wall clock has the time of this run: it cannot be paused, stepped or made faster");
    return;
  }
  switch (command.action) {
    case ViewAction::pause:
      gate_.pause();
      break;
    case ViewAction::run:
      gate_.run();
      break;
    case ViewAction::step:
      gate_.step(command.ticks);
      break;
    case ViewAction::speed:
      gate_.set_speed(command.speed);
      break;
    case ViewAction::restart:
      restart_seed_ = command.seed;
      break;
    case ViewAction::stop:
      press_stop(command.robot);
      break;
    case ViewAction::fault:
      begin_fault(command);
      break;
  }
}

void LiveView::press_stop(std::optional<std::size_t> robot) {
  if (robot && *robot >= run_.robots) {
    note(fmt::format("there is no robot {}", *robot));
    return;
  }
  const std::size_t first = robot.value_or(0);
  const std::size_t behind = robot ? first + 1 : run_.robots;
  for (std::size_t one = first; one < behind; ++one) {
    stop_due_[one] = state_.tick;
  }
  gate_.run();
  note(robot ? fmt::format("emergency stop of robot {}", *robot) : "emergency stop");
}

void LiveView::send_stops() {
  constexpr std::uint32_t again_ticks = 10;
  for (std::size_t robot = 0; robot < run_.robots; ++robot) {
    auto& due = stop_due_[robot];
    if (is_due(due)) {
      run_.say(robot, Operator::emergency_stop());
      due = state_.tick + again_ticks;
    }
    if (due && *due != state_.tick + again_ticks && is_stopped(state_.robots[robot])) {
      due.reset();
    }
  }
}

void LiveView::begin_fault(const ViewCommand& command) {
  const std::size_t robot = command.robot.value_or(0);
  const std::string_view name = info_of(command.kind).name;
  const bool begun = robot < run_.robots && run_.faults[robot] != nullptr &&
                     run_.faults[robot]->begin(command.kind, command.for_ms);
  note(begun ? fmt::format("{} on robot {}'s bus for {} ms", name, robot, command.for_ms)
             : fmt::format("{} cannot begin on robot {}'s bus now", name, robot));
}

void LiveView::note(std::string_view text) {
  ++state_.note.number;
  state_.note.text.fill('\0');
  std::copy_n(text.begin(), std::min(text.size(), state_.note.text.size() - 1), state_.note.text.begin());
}

void LiveView::tally(std::size_t robot, const RobotSnapshot& seen, bool with_wheels) {
  LiveRobot& into = state_.robots[robot];
  into.pose = seen.pose;
  into.velocity_m_s = seen.velocity_m_s;
  for (const StampedFrame& stamped : seen.frames) {
    SeenMessage& message = into.messages[kind_of_identifier[stamped.frame.id % identifiers]];
    ++message.count;
    message.last = stamped.frame;
  }
  if (with_wheels) {
    into.wheels[into.wheel_samples++ % kept_wheel_samples] = {.tick = state_.tick,
                                                              .command = into.messages[wheel_command].last,
                                                              .state = into.messages[wheel_state].last};
  }
}

// A kick's target lies ahead of where the robot stood at the first decision.
void LiveView::watch_episode(const Snapshot& snapshot) {
  if (snapshot.deciding && !state_.deciding && !snapshot.robots.empty()) {
    state_.target = snapshot.robots.front().pose;
    state_.contact_m.reset();
  }
  if (snapshot.deciding && snapshot.contact && !state_.contact_m) {
    state_.contact_m = snapshot.ball.position_m;
  }
  state_.deciding = snapshot.deciding;
}

void LiveView::show() {
  exchange_->wanted.store(false, std::memory_order_relaxed);
  state_.paused = gate_.is_paused();
  state_.speed = gate_.speed();
  state_.lateness_max_us = gate_.take_lateness_max_us();
  for (std::size_t robot = 0; robot < run_.robots; ++robot) {
    if (const InProcessLink* link = run_.controllers[robot]) {
      state_.robots[robot].inputs = link->controller().pilot().inputs();
    }
  }
  exchange_->states.next() = state_;
  exchange_->states.publish();
}

}  // namespace striker::sil
