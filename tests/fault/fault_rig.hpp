// SPDX-License-Identifier: Apache-2.0
// Faults in one call each: what becomes of frames that pass them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "firmware/can/codec.hpp"
#include "sil/fault/link/link_faults.hpp"
#include "sil/fault/plan/fault_plan.hpp"

namespace striker::sil {

template <class Message>
inline constexpr std::uint16_t identifier = can::layout<Message>.info.id;

inline TimedFault fault_of(FaultKind kind, std::uint32_t from, std::uint32_t until) {
  return {.fault = usual(kind, 0, 0), .from = from, .until = until};
}

inline Random any_random() {
  return {7, 0, 900};
}

// Shows what reached it in the last tick, and answers with what it is told to.
class ShowLink final : public ControllerLink {
 public:
  std::vector<can::Frame> got;
  std::vector<can::Frame> answers;

  void send(std::uint32_t, std::span<const can::Frame> frames) override {
    got.assign(frames.begin(), frames.end());
  }
  void collect(std::uint32_t, std::vector<can::Frame>& answer) override {
    answer.insert(answer.end(), answers.begin(), answers.end());
  }
};

// One fault in front of a ShowLink.
class FaultRig {
 public:
  explicit FaultRig(const TimedFault& fault) : FaultRig(make_frame_fault(fault, any_random())) {}
  explicit FaultRig(std::unique_ptr<FrameFault> fault) : link_(end, one(std::move(fault))) {}

  std::vector<can::Frame> pass(std::uint32_t tick, const std::vector<can::Frame>& frames) {
    answer.clear();
    link_.send(tick, frames);
    link_.collect(tick, answer);
    return end.got;
  }

  ShowLink end;
  std::vector<can::Frame> answer;  // what came back in the last tick

 private:
  static std::vector<std::unique_ptr<FrameFault>> one(std::unique_ptr<FrameFault> fault) {
    std::vector<std::unique_ptr<FrameFault>> faults;
    faults.push_back(std::move(fault));
    return faults;
  }

  LinkFaults link_;
};

// A tick of a seat: a wheel state that tells its tick, and SYNC.
class SeatFrames {
 public:
  std::vector<can::Frame> at(std::uint32_t tick) {
    const auto number = static_cast<std::int32_t>(tick);
    return {can::send(can::WheelState{.left_mm_s = number, .right_mm_s = -number}, wheels_),
            can::send(can::Sync{.tick = number}, sync_)};
  }

 private:
  can::SendCounter wheels_;
  can::SendCounter sync_;
};

inline std::size_t count_of(const std::vector<can::Frame>& frames, std::uint16_t id) {
  std::size_t count = 0;
  for (const can::Frame& frame : frames) {
    count += frame.id == id ? 1 : 0;
  }
  return count;
}

}  // namespace striker::sil
