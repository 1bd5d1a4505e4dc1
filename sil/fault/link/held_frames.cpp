// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/link/held_frames.hpp"

#include <algorithm>
#include <deque>
#include <utility>

#include "firmware/can/messages.hpp"

namespace striker::sil {

namespace {

// Frames come `count` ticks later, or, with jitter, 0 to `count` ticks later. What is on its way when the window
// ends comes all the same. Late frames come before those of the tick.
class LateFrames final : public FrameFault {
 public:
  LateFrames(const TimedFault& fault, const Random& random) : fault_(fault), random_(random) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    pass(tick, frames, to_controller_);
  }
  void from_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    pass(tick, frames, from_controller_);
  }

 private:
  struct OnItsWay {
    can::Frame frame;
    std::uint32_t due = 0;
  };

  void pass(std::uint32_t tick, std::vector<can::Frame>& frames, std::vector<OnItsWay>& held) {
    std::vector<can::Frame> passed;
    std::erase_if(held, [&](const OnItsWay& late) {
      if (late.due == tick) {
        passed.push_back(late.frame);
      }
      return late.due == tick;
    });
    for (const can::Frame& frame : frames) {
      const std::uint32_t lateness = fault_.lasts(tick) && concerns(fault_.fault, frame) ? draw() : 0;
      if (lateness == 0) {
        passed.push_back(frame);
      } else {
        held.push_back({frame, tick + lateness});
      }
    }
    frames = std::move(passed);
  }

  std::uint32_t draw() {
    const std::uint32_t most = fault_.fault.count;
    return fault_.fault.kind == FaultKind::delay ? most : static_cast<std::uint32_t>(random_.below(most + 1));
  }

  TimedFault fault_;
  Random random_;
  std::vector<OnItsWay> to_controller_;
  std::vector<OnItsWay> from_controller_;
};

// Remembers the last `count` frames of the message, and in the window sends them in turn, in place of each that
// would come. Of a message that comes on events, one comes in every tick of the window.
class Replay final : public FrameFault {
 public:
  explicit Replay(const TimedFault& fault) : fault_(fault), on_events_(is_on_events(fault.fault)) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    pass(tick, frames, true);
  }
  void from_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    pass(tick, frames, false);
  }

 private:
  static bool is_on_events(const Fault& fault) {
    bool on_events = false;
    can::for_each_layout([&](const auto& message) {
      on_events = on_events || (message.info.id == fault.message && message.info.period_ms == 0);
    });
    return on_events;
  }

  void pass(std::uint32_t tick, std::vector<can::Frame>& frames, bool to_controller) {
    const bool lasts = fault_.lasts(tick) && !recorded_.empty();
    if (lasts && on_events_ && to_controller) {
      frames.insert(frames.begin(), next());
      return;
    }
    for (can::Frame& frame : frames) {
      if (frame.id != fault_.fault.message) {
        continue;
      }
      if (lasts) {
        frame = next();
      } else if (tick < fault_.from) {
        remember(frame);
      }
    }
  }

  void remember(const can::Frame& frame) {
    recorded_.push_back(frame);
    if (recorded_.size() > fault_.fault.count) {
      recorded_.pop_front();
    }
  }

  can::Frame next() { return recorded_[sent_++ % recorded_.size()]; }

  TimedFault fault_;
  bool on_events_;
  std::deque<can::Frame> recorded_;
  std::size_t sent_ = 0;
};

}  // namespace

std::unique_ptr<FrameFault> make_held_frames(const TimedFault& fault, const Random& random) {
  switch (fault.fault.kind) {
    case FaultKind::delay:
    case FaultKind::jitter:
      return std::make_unique<LateFrames>(fault, random);
    case FaultKind::replay:
      return std::make_unique<Replay>(fault);
    default:
      return nullptr;
  }
}

}  // namespace striker::sil
