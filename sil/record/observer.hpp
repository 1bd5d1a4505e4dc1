// SPDX-License-Identifier: Apache-2.0
// Who watches a run: logs, records, progress, pacing. A scenario calls every observer at the same three
// points, whatever it is; nothing an observer does changes a result.
#pragma once

#include <cstdint>
#include <span>

#include "sil/bus/stamped_frame.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

struct RobotSnapshot {
  Pose pose;
  Vec2 velocity_m_s;
  std::span<const StampedFrame> frames;  // on its bus in this tick, in the bus's order
};

// The true world after a tick, as no camera or encoder sees it. Its spans are valid during the call alone.
struct Snapshot {
  std::uint32_t tick = 0;                 // ms since the run began
  std::uint64_t episode = 0;              // the number of the one that is played
  bool deciding = false;                  // within the episode's decisions
  bool contact = false;                   // a robot has touched the ball in an earlier tick of the episode
  std::span<const RobotSnapshot> robots;  // in the world's order
  BallState ball;
};

class Observer {
 public:
  virtual ~Observer() = default;
  // Nothing of the tick was sent yet; a pacer waits here.
  virtual void begin_tick() {}
  virtual void end_tick(const Snapshot& /*snapshot*/) {}
  virtual void end_episode() {}
  // The run is over, or was stopped: files are completed here. Not called if it ended in an exception.
  virtual void end_run() {}
};

}  // namespace striker::sil
