#include "sil/bus/timed_link.hpp"

#include <algorithm>

#include "firmware/can/codec.hpp"
#include "sil/bus/frame_bits.hpp"

namespace striker::sil {

namespace {

constexpr std::int64_t tick_ns = 1'000'000;

bool is_controllers(const can::Frame& frame) {
  bool found = false;
  can::for_each_layout([&](const auto& message) {
    found = found || (message.info.id == frame.id && message.info.sender == can::Node::controller);
  });
  return found;
}

bool answers_a_picture(const can::Frame& frame) {
  can::Decision decision;
  return can::is<can::Decision>(frame) && can::unpack(frame, decision) == can::Verdict::accepted &&
         decision.extrapolated == 0;
}

}  // namespace

TimedLink::TimedLink(ControllerLink& controller, const TimedBusOptions& options)
    : controller_(&controller), options_(options), bus_(options.bit_ns) {}

void TimedLink::queue(const can::Frame& frame, std::int64_t at_ns) {
  report_.replaced += bus_.withdraw(frame.id) ? 1 : 0;
  bus_.queue({frame, frame_bits(frame), at_ns});
}

void TimedLink::step_controller(const can::Frame& sync, std::int64_t at_ns) {
  can::Sync tick;
  static_cast<void>(can::unpack(sync, tick));
  to_controller_.push_back(sync);
  reply_.clear();
  controller_->exchange(static_cast<std::uint32_t>(tick.tick), to_controller_, reply_);
  to_controller_.clear();
  for (const can::Frame& frame : reply_) {
    queue(frame, at_ns + options_.step_ns);
  }
  if (std::any_of(reply_.begin(), reply_.end(), answers_a_picture)) {
    deciding_command_ = reply_.back();
  }
}

void TimedLink::receive(const SentFrame& sent) {
  const can::Frame& frame = sent.queued.frame;
  seen_.push_back({sent.received_ns, frame});
  if (can::is<can::Sync>(frame)) {
    step_controller(frame, sent.received_ns);
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

void TimedLink::exchange(std::uint32_t tick, std::span<const can::Frame> sent,
                         std::vector<can::Frame>& answer) {
  answer.insert(answer.end(), to_simulator_.begin(), to_simulator_.end());
  to_simulator_.clear();
  seen_.clear();
  const std::int64_t begin_ns = tick * tick_ns;
  for (const can::Frame& frame : sent) {
    const bool picture = can::is<can::VisionPose>(frame) || can::is<can::VisionBall>(frame);
    const std::int64_t at_ns = begin_ns + (picture ? options_.vision_phase_ns : 0);
    picture_ns_ = picture ? at_ns : picture_ns_;
    queue(frame, at_ns);
  }
  now_ns_ = begin_ns + tick_ns;
  while (const auto frame = bus_.next(now_ns_)) {
    receive(*frame);
  }
}

TimedBusReport TimedLink::report() const {
  TimedBusReport report = report_;
  report.busy_share = now_ns_ == 0 ? 0.0 : static_cast<double>(bus_.busy_ns()) / static_cast<double>(now_ns_);
  return report;
}

}  // namespace striker::sil
