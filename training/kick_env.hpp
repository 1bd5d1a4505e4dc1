// One kick episode after another, as a learner meets them: a state, an action, a reward. The servo plant of
// the paper: wheels that hold a set-point within a torque ceiling, physics steps of 10 ms, five a decision.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <variant>

#include "state.hpp"
#include "world/kick_task.hpp"
#include "world/planar_world.hpp"
#include "world/world.hpp"

namespace striker::training {

// What the actions mean, the set-point of both wheels: forward, stop, backward (paper, section IV.A).
inline constexpr std::array set_points_m_s = {2.55, 0.0, -2.55};
inline constexpr double torque_ceiling_Nm = 0.4;

inline constexpr double physics_step_s = 0.010;
inline constexpr int steps_per_decision = 5;

// Evaluations number their episodes from 0. Other uses begin so far away that no evaluation meets them.
inline constexpr std::uint64_t training_episodes = std::uint64_t{1} << 63;
inline constexpr std::uint64_t validation_episodes = std::uint64_t{1} << 62;
inline constexpr std::uint64_t calibration_episodes = std::uint64_t{1} << 61;

// `exact`: the world's own velocities. `estimated`: as the firmware has them, the ball's from the last two
// vision frames (50 ms apart, exact positions), the robot's from its wheels.
enum class Velocities { exact, estimated };

// `fast`: sil::PlanarWorld. `full`: sil::World with the wheel bodies, the reference.
enum class World { fast, full };

struct EnvConfig {
  Velocities velocities = Velocities::exact;
  Equations equations = Equations::corrected;
  World world = World::fast;
};

struct StepResult {
  double reward = 0.0;
  bool contact = false;  // the first contact was in this decision
  bool last = false;     // this was decision 40
};

class KickEnv {
 public:
  explicit KickEnv(const EnvConfig& config);

  void reset(const sil::KickStart& start);
  StepResult step(int action);  // up to 40 times after a reset
  void coast();                 // 100 ms with set-point 0

  [[nodiscard]] const RcsState& state() const { return state_; }
  [[nodiscard]] const sil::KickOutcome& outcome() const { return episode_.outcome(); }
  [[nodiscard]] double simulated_s() const { return simulated_s_; }  // since it was made

 private:
  void drive(double set_point_m_s, int steps);
  void observe();

  EnvConfig config_;
  std::variant<sil::PlanarWorld, sil::World> world_;
  sil::KickEpisode episode_;
  sil::Vec2 last_ball_m_;  // one vision frame ago
  RcsState state_;
  int decisions_ = 0;
  double simulated_s_ = 0.0;
};

using Choice = std::function<int(const RcsState&)>;

// Plays an episode until the kick is measured, or to its end and 100 ms on, so that a late one is.
sil::KickOutcome play(KickEnv& env, const sil::KickStart& start, const Choice& choose);

}  // namespace striker::training
