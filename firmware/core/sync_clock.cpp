#include "firmware/core/sync_clock.hpp"

namespace striker::core {

bool SyncClock::take(const can::Frame& frame, Outputs& outputs) {
  if (!can::is<can::Sync>(frame)) {
    if (count_ < capacity) {
      waiting_[count_++] = frame;
    }
    return false;
  }
  can::Sync sync;
  can::ReceiveCounter anew;
  if (can::receive(frame, anew, sync) == can::Verdict::accepted && sync.tick == 0) {
    controller_ = {};
    counter_ = anew;
    tick_ = 0;
    count_ = 0;
  } else if (can::receive(frame, counter_, sync) != can::Verdict::accepted) {
    return false;
  }
  // The wire carries 31 bits of the tick: the difference carries it over the wrap.
  tick_ += (static_cast<std::uint32_t>(sync.tick) - tick_) & 0x7FFFFFFFU;
  controller_.step({.tick = tick_, .frames = std::span(waiting_).first(count_)}, outputs);
  count_ = 0;
  return true;
}

}  // namespace striker::core
