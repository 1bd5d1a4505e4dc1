// SPDX-License-Identifier: Apache-2.0
#include "sil/bus/timed_link.hpp"

#include <algorithm>

#include "firmware/can/codec.hpp"
#include "firmware/loop/tick.hpp"
#include "sil/bus/controller_messages.hpp"
#include "sil/bus/frame_bits.hpp"

namespace striker::sil {

namespace {

bool answers_a_picture(const can::Frame& frame) {
  can::Decision decision;
  return can::is<can::Decision>(frame) && can::unpack(frame, decision) == can::Verdict::accepted &&
         decision.extrapolated == 0;
}

}  // namespace

TimedLink::TimedLink(ControllerLink& controller, const TimedBusOptions& options)
    : controller_(&controller), options_(options), bus_(options.bit_ns) {}

void TimedLink::send(std::uint32_t tick, std::span<const can::Frame> frames) {
  arrived_.swap(to_simulator_);
  to_simulator_.clear();
  seen_.clear();
  const std::int64_t begin_ns = tick * loop::tick_period_ns;
  for (const can::Frame& frame : frames) {
    const bool picture = can::is<can::VisionPose>(frame) || can::is<can::VisionBall>(frame);
    const std::int64_t at_ns = begin_ns + (picture ? options_.vision_phase_ns : 0);
    picture_ns_ = picture ? at_ns : picture_ns_;
    queue(frame, at_ns);
  }
  now_ns_ = begin_ns + loop::tick_period_ns;
  run_until_a_step();
}

void TimedLink::collect(std::uint32_t, std::vector<can::Frame>& answer) {
  while (step_) {
    end_step();
    run_until_a_step();
  }
  answer.insert(answer.end(), arrived_.begin(), arrived_.end());
}

void TimedLink::queue(const can::Frame& frame, std::int64_t at_ns) {
  report_.replaced += bus_.withdraw(frame.id) ? 1 : 0;
  bus_.queue({frame, frame_bits(frame), at_ns});
}

// Runs the bus until the controller is to step, or to the end of the tick.
void TimedLink::run_until_a_step() {
  while (!step_) {
    const auto frame = bus_.next(now_ns_);
    if (!frame) {
      return;
    }
    receive(*frame);
  }
}

void TimedLink::receive(const SentFrame& sent) {
  const can::Frame& frame = sent.queued.frame;
  seen_.push_back({frame, sent.received_ns});
  if (can::is<can::Sync>(frame)) {
    begin_step(frame, sent.received_ns);
  } else if (!is_controllers(frame)) {
    to_controller_.push_back(frame);
  } else {
    to_simulator_.push_back(frame);
    if (deciding_command_ == frame) {
      deciding_command_.reset();
      ++report_.decisions;
      report_.decision_latency_max_ns =
          std::max(report_.decision_latency_max_ns, sent.received_ns - picture_ns_);
    }
  }
}

void TimedLink::begin_step(const can::Frame& sync, std::int64_t at_ns) {
  can::Sync message;
  static_cast<void>(can::unpack(sync, message));
  step_ = PendingStep{static_cast<std::uint32_t>(message.tick), at_ns};
  to_controller_.push_back(sync);
  controller_->send(step_->tick, to_controller_);
  to_controller_.clear();
}

void TimedLink::end_step() {
  reply_.clear();
  controller_->collect(step_->tick, reply_);
  for (const can::Frame& frame : reply_) {
    // It ends a simulator's tick, not a bus's: it takes no time there.
    if (can::is<can::EndOfTick>(frame)) {
      continue;
    }
    queue(frame, step_->sync_ns + options_.step_ns);
  }
  if (std::any_of(reply_.begin(), reply_.end(), answers_a_picture)) {
    const auto command = std::find_if(reply_.begin(), reply_.end(), is_drive_command);
    deciding_command_ = command != reply_.end() ? std::optional(*command) : std::nullopt;
  }
  step_.reset();
}

TimedBusReport TimedLink::report() const {
  TimedBusReport report = report_;
  report.busy_share = now_ns_ == 0 ? 0.0 : static_cast<double>(bus_.busy_ns()) / static_cast<double>(now_ns_);
  return report;
}

}  // namespace striker::sil
