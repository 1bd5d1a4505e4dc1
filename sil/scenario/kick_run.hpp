// Plays kick episodes over a bus: vision and wheel states out, wheel commands in, one tick of 1 ms at a time.
//
// An episode takes 2,200 ticks: disarm and the first picture; 50 ticks later the second, then arm; 50 later
// the third, which is decision 0 and starts the ball; 40 decisions; 100 ticks to see the ball leave. Until
// decision 0 the robot is held and the ball led along its path. A latched fault is cleared before arming.
// Tick 0 is SYNC alone, and the first episode begins at tick 50.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sil/bus/controller_link.hpp"
#include "sil/robot/vision.hpp"
#include "sil/robot/wheel_drives.hpp"
#include "sil/task/kick_report.hpp"
#include "sil/task/kick_task.hpp"

namespace striker::sil {

struct KickRunOptions {
  PlantKind plant = PlantKind::drive;
  PoseMode pose = PoseMode::origin;
  std::uint64_t seed = 1;
  std::uint64_t first_episode = 0;
  std::uint64_t episodes = 20;
  bool lockstep = true;  // SYNC ends every tick
};

// What happened in one tick, for logs and records.
struct TickRecord {
  std::uint32_t tick = 0;
  std::uint64_t episode = 0;
  bool deciding = false;                            // within the 40 decisions
  bool contact = false;                             // the ball was touched in an earlier tick
  const std::vector<can::Frame>* frames = nullptr;  // the simulator's, then the controller's
};

struct KickRunHooks {
  std::function<void()> begin_tick;  // a pacer may wait here
  std::function<void(const TickRecord&)> end_tick;
  std::function<void(const KickOutcome&)> end_episode;
  std::function<bool()> stop;  // true ends the run before the next tick
};

class KickRunner {
 public:
  KickRunner(const KickRunOptions& options, ControllerLink& link, KickRunHooks hooks);

  // All episodes, or those that were completed before a stop; leaves the controller disarmed.
  void run();

  [[nodiscard]] const std::vector<KickOutcome>& outcomes() const { return outcomes_; }
  [[nodiscard]] double simulated_s() const { return tick_ * 0.001; }
  // The policy's identity from the controller's version frame, 8 hexadecimal digits; "unknown" before one
  // came.
  [[nodiscard]] const std::string& policy() const { return policy_; }
  [[nodiscard]] const WheelDrives& drives() const { return drives_; }

 private:
  bool boot();
  bool play_episode(std::uint64_t episode);
  void prepare_tick(std::uint32_t episode_tick, const KickStart& start);
  bool run_tick();
  void take_answer();
  void send_mode(can::Mode mode);
  void send_picture(const Pose& robot, Vec2 ball_m);

  KickRunOptions options_;
  ControllerLink* link_;
  KickRunHooks hooks_;
  std::unique_ptr<Plant> plant_;
  World world_;
  WheelDrives drives_;
  Vision vision_;
  can::SendCounter mode_counter_;
  can::SendCounter sync_counter_;

  std::uint32_t tick_ = 0;
  KickEpisode episode_;
  bool moving_ = false;  // the world runs
  TickRecord record_;
  std::vector<can::Frame> frames_;  // of this tick
  std::vector<can::Frame> answer_;
  std::vector<KickOutcome> outcomes_;
  std::string policy_ = "unknown";
  bool controller_faulty_ = false;
};

}  // namespace striker::sil
