// SPDX-License-Identifier: Apache-2.0
// Lockstep from a bus on which anybody may speak: time never goes back but by Sync(0), every answer names its Sync,
// and no burst, leap or restart loses an emergency stop.
#include "firmware/loop/sync_ticks.hpp"

#include <deque>
#include <vector>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/bus.hpp"
#include "firmware/loop/tick_loop.hpp"
#include "tests/fuzz/support/any_frame.hpp"

namespace striker::fuzz {
namespace {

class QueueBus {
 public:
  std::deque<can::Frame> waiting;
  std::vector<can::Frame> sent;
  can::BusHealth now = can::BusHealth::active;
  std::uint32_t lost_frames = 0;

  void poll() {}
  loop::Received<std::int64_t> receive(std::size_t most) {
    batch_.clear();
    while (batch_.size() < most && !waiting.empty()) {
      batch_.push_back(waiting.front());
      waiting.pop_front();
    }
    return {.frames = batch_};
  }
  std::uint32_t lost() { return std::exchange(lost_frames, 0); }
  std::size_t try_send(std::span<const can::Frame> frames) {
    sent.assign(frames.begin(), frames.end());
    return frames.size();
  }
  [[nodiscard]] can::BusHealth health() const { return now; }

 private:
  std::vector<can::Frame> batch_;
};

class SyncRig {
 public:
  explicit SyncRig(Bytes& bytes) : bytes_(bytes), loop_(loop::built_in_robot, bus_, ticks_) {}

  void run() {
    while (!bytes_.done()) {
      operate(bytes_.u8() & 31U);
    }
    turn();
  }

 private:
  using Ticks = loop::SyncTicks;

  void operate(std::uint8_t operation) {
    switch (operation) {
      case letter('y'):
        return sync(1);
      case letter('l'):
        return sync(bytes_.u16());
      case letter('k'):
        return sync(bytes_.u32());
      case letter('z'):
        return sync(0U - tick_);  // Sync(0)
      case letter('r'):
        return honest_ticks(1 + bytes_.u8());
      case letter('f'):
        return bus_.waiting.push_back(forged_frame(bytes_));
      case letter('x'):
        return bus_.waiting.push_back(raw_frame(bytes_));
      case letter('b'):
        return burst(bytes_.u8());
      case letter('s'):
        return bus_.waiting.push_back(can::send(can::EmergencyStop{}, stop_));
      case letter('o'):
        bus_.now = static_cast<can::BusHealth>(bytes_.u8() % 3);
        return;
      case letter('i'):
        bus_.lost_frames = bytes_.u8();
        return;
      case letter('d'):
        return ticks_.overdue();
      default:
        return turn();
    }
  }

  void sync(std::uint32_t ahead) {
    tick_ = (tick_ + ahead) & 0x7FFFFFFFU;
    bus_.waiting.push_back(can::send(can::Sync{.tick = static_cast<std::int32_t>(tick_)}, sync_));
  }

  void honest_ticks(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      bus_.waiting.push_back(can::send(can::WheelState{}, wheels_));
      sync(1);
      turn();
    }
  }

  void burst(std::uint32_t frames) {
    for (std::uint32_t i = 0; i < frames; ++i) {
      bus_.waiting.push_back(can::send(can::WheelState{}, wheels_));
    }
  }

  void turn() {
    const std::deque<can::Frame> offered = bus_.waiting;
    bus_.sent.clear();
    if (!loop_.turn()) {
      require(bus_.waiting.empty(), "a turn without a tick leaves no frame behind");
      note_stops(offered);
      return;
    }
    note_stops({offered.begin(), offered.end() - static_cast<std::ptrdiff_t>(bus_.waiting.size())});
    check();
  }

  void note_stops(const std::deque<can::Frame>& taken) {
    for (const can::Frame& frame : taken) {
      stopped_ = stopped_ || is_correct<can::EmergencyStop>(frame);
      can::Sync sync;
      if (holds(frame, sync)) {
        last_sync_ = sync.tick;
      }
    }
  }

  void check() {
    const core::Faults faults = loop_.node().controller().faults();
    require(!bus_.sent.empty() && bus_.sent.size() <= can::FrameList::capacity,
            "a tick has frames, and room for them");
    can::EndOfTick end;
    if (ticks_.answered_sync()) {
      require(holds(bus_.sent.back(), end) && end.tick == last_sync_, "an answer names its Sync");
      require(!stopped_ || (faults & core::set_of(core::Fault::emergency_stop)) != 0, "no stop is lost");
    } else {
      require(!can::is<can::EndOfTick>(bus_.sent.back()), "a tick of the port's own answers no Sync");
      require(loop_.node().controller().state() == core::State::fault, "a tick of the port's own is a fault");
    }
    const auto status = loop_.node().controller().state();
    for (const can::Frame& frame : bus_.sent) {
      require(!moves(frame) || status == core::State::active, "what moves is armed");
    }
  }

  Bytes& bytes_;
  QueueBus bus_;
  Ticks ticks_;
  loop::TickLoop<loop::BuiltInNode, QueueBus&, Ticks&> loop_;
  std::uint32_t tick_ = 0;
  std::int32_t last_sync_ = 0;
  bool stopped_ = false;  // nobody in this target clears it
  can::SendCounter sync_, wheels_, stop_;
};

}  // namespace
}  // namespace striker::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  striker::fuzz::Bytes bytes(data, size);
  striker::fuzz::SyncRig(bytes).run();
  return 0;
}
