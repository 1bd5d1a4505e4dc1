// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/link/changed_frames.hpp"

#include <algorithm>
#include <utility>

#include "firmware/can/messages.hpp"

namespace striker::sil {

namespace {

// The same in both directions.
class ChangedFrames : public FrameFault {
 public:
  ChangedFrames(const TimedFault& fault, const Random& random) : fault_(fault), random_(random) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>& frames) final { pass(tick, frames); }
  void from_controller(std::uint32_t tick, std::vector<can::Frame>& frames) final { pass(tick, frames); }

 protected:
  virtual void change(std::vector<can::Frame>& frames) = 0;

  [[nodiscard]] const Fault& fault() const { return fault_.fault; }
  [[nodiscard]] Random& random() { return random_; }
  [[nodiscard]] bool hits() { return random_.uniform() < fault().probability; }

 private:
  void pass(std::uint32_t tick, std::vector<can::Frame>& frames) {
    if (fault_.lasts(tick)) {
      change(frames);
    }
  }

  TimedFault fault_;
  Random random_;
};

class Loss final : public ChangedFrames {
 public:
  using ChangedFrames::ChangedFrames;

 private:
  void change(std::vector<can::Frame>& frames) override {
    std::erase_if(frames, [&](const can::Frame& frame) { return concerns(fault(), frame) && hits(); });
  }
};

// One draw for pose and ball.
class PictureLoss final : public ChangedFrames {
 public:
  using ChangedFrames::ChangedFrames;

 private:
  void change(std::vector<can::Frame>& frames) override {
    const auto is_picture = [](const can::Frame& frame) {
      return can::is<can::VisionPose>(frame) || can::is<can::VisionBall>(frame);
    };
    if (std::any_of(frames.begin(), frames.end(), is_picture) && hits()) {
      std::erase_if(frames, is_picture);
    }
  }
};

// The bits differ from each other, so that `count` of them are wrong.
class FlipBits final : public ChangedFrames {
 public:
  using ChangedFrames::ChangedFrames;

 private:
  void change(std::vector<can::Frame>& frames) override {
    for (can::Frame& frame : frames) {
      if (frame.length > 0 && concerns(fault(), frame) && hits()) {
        flip(frame);
      }
    }
  }

  void flip(can::Frame& frame) {
    const std::uint32_t bits = frame.length * 8U;
    std::uint64_t mask = 0;
    for (std::uint32_t flipped = 0; flipped < fault().count;) {
      const std::uint64_t bit = std::uint64_t{1} << random().below(bits);
      flipped += (mask & bit) == 0 ? 1 : 0;
      mask |= bit;
    }
    for (std::size_t byte = 0; byte < frame.length; ++byte) {
      frame.data[byte] ^= static_cast<std::uint8_t>(mask >> (8 * byte));
    }
  }
};

class WrongLength final : public ChangedFrames {
 public:
  using ChangedFrames::ChangedFrames;

 private:
  void change(std::vector<can::Frame>& frames) override {
    for (can::Frame& frame : frames) {
      if (concerns(fault(), frame) && hits()) {
        frame.length = static_cast<std::uint8_t>((frame.length + 1 + random().below(8)) % 9);
      }
    }
  }
};

// Sync and EndOfTick stay where they are: they are the ends of a tick.
class Reorder final : public ChangedFrames {
 public:
  using ChangedFrames::ChangedFrames;

 private:
  void change(std::vector<can::Frame>& frames) override {
    const auto end = std::find_if(frames.begin(), frames.end(), is_lockstep);
    for (auto count = end - frames.begin(); count > 1; --count) {
      const auto with = static_cast<std::ptrdiff_t>(random().below(static_cast<std::uint64_t>(count)));
      std::swap(frames[static_cast<std::size_t>(count - 1)], frames[static_cast<std::size_t>(with)]);
    }
  }
};

}  // namespace

std::unique_ptr<FrameFault> make_changed_frames(const TimedFault& fault, const Random& random) {
  switch (fault.fault.kind) {
    case FaultKind::loss:
      return std::make_unique<Loss>(fault, random);
    case FaultKind::picture_loss:
      return std::make_unique<PictureLoss>(fault, random);
    case FaultKind::flip_bits:
      return std::make_unique<FlipBits>(fault, random);
    case FaultKind::wrong_length:
      return std::make_unique<WrongLength>(fault, random);
    case FaultKind::reorder:
      return std::make_unique<Reorder>(fault, random);
    default:
      return nullptr;
  }
}

}  // namespace striker::sil
