// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/link/injected_frames.hpp"

#include <algorithm>
#include <optional>

#include "firmware/can/codec.hpp"

namespace striker::sil {

namespace {

// All identifiers of the table but those of lockstep, each with its length.
std::vector<can::Frame> forms_of_frames(const Fault& fault) {
  std::vector<can::Frame> forms;
  can::for_each_layout([&](const auto& message) {
    can::Frame form{};
    form.id = message.info.id;
    form.length = message.info.length;
    if (concerns(fault, form)) {
      forms.push_back(form);
    }
  });
  return forms;
}

void put_before(const std::vector<can::Frame>& injected, std::vector<can::Frame>& frames) {
  frames.insert(frames.begin(), injected.begin(), injected.end());
}

class Babble final : public FrameFault {
 public:
  Babble(const TimedFault& fault, const Random& random) : fault_(fault), frames_(fault.fault, random) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    injected_.clear();
    for (std::uint32_t i = 0; fault_.lasts(tick) && i < fault_.fault.count; ++i) {
      injected_.push_back(frames_.draw());
    }
    put_before(injected_, frames);
  }
  void from_controller(std::uint32_t, std::vector<can::Frame>& frames) override {
    put_before(injected_, frames);
  }

 private:
  TimedFault fault_;
  RandomFrames frames_;
  std::vector<can::Frame> injected_;
};

// The burst in front of the stop is on the identifiers of no operator, so that nothing but the stop can stop.
class EmergencyStopFault final : public FrameFault {
 public:
  EmergencyStopFault(const TimedFault& fault, const Random& random)
      : fault_(fault), frames_(burst_of(fault.fault), random) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    if (tick != fault_.from) {
      return;
    }
    std::vector<can::Frame> injected;
    for (std::uint32_t i = 0; i < fault_.fault.count; ++i) {
      injected.push_back(frames_.draw());
    }
    can::SendCounter counter{.next = 11};
    injected.push_back(can::send(can::EmergencyStop{}, counter));
    put_before(injected, frames);
  }

 private:
  static Fault burst_of(Fault fault) {
    fault.message = can::layout<can::VisionBall>.info.id;
    return fault;
  }

  TimedFault fault_;
  RandomFrames frames_;
};

// Copies of frames, under their own identifier or another. Those under another are heard on both sides.
class Copies final : public FrameFault {
 public:
  explicit Copies(const TimedFault& fault) : fault_(fault) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    forged_.clear();
    copy(tick, frames);
  }
  void from_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    copy(tick, frames);
    put_before(forged_, frames);
    forged_.clear();
  }

 private:
  void copy(std::uint32_t tick, std::vector<can::Frame>& frames) {
    if (!fault_.lasts(tick)) {
      return;
    }
    const bool forges = fault_.fault.kind == FaultKind::masquerade;
    std::vector<can::Frame> all;
    for (const can::Frame& frame : frames) {
      can::Frame copied = frame;
      if (concerns(fault_.fault, frame)) {
        copied.id = forges ? fault_.fault.as : frame.id;
        all.insert(all.end(), forges ? 1 : fault_.fault.count, copied);
        if (forges) {
          forged_.push_back(copied);
        }
      }
      all.push_back(frame);
    }
    frames = std::move(all);
  }

  TimedFault fault_;
  std::vector<can::Frame> forged_;
};

}  // namespace

RandomFrames::RandomFrames(const Fault& fault, const Random& random)
    : forms_(forms_of_frames(fault)), random_(random) {}

can::Frame RandomFrames::draw() {
  can::Frame frame = forms_[random_.below(forms_.size())];
  std::uint64_t bytes = random_.next();
  for (std::size_t i = 0; i < frame.length; ++i, bytes >>= 8U) {
    frame.data[i] = static_cast<std::uint8_t>(bytes & 0xFFU);
  }
  return frame;
}

std::unique_ptr<FrameFault> make_injected_frames(const TimedFault& fault, const Random& random) {
  switch (fault.fault.kind) {
    case FaultKind::masquerade:
    case FaultKind::duplicate:
      return std::make_unique<Copies>(fault);
    case FaultKind::babble:
      return std::make_unique<Babble>(fault, random);
    case FaultKind::emergency_stop:
      return std::make_unique<EmergencyStopFault>(fault, random);
    default:
      return nullptr;
  }
}

}  // namespace striker::sil
