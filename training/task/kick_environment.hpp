// One kick episode after another, as a learner meets them: a state, an action, a reward. The servo plant of
// the paper: wheels that hold a set-point within a torque ceiling, physics steps of 10 ms, five a decision.
#pragma once

#include <cstdint>
#include <functional>
#include <variant>
#include <vector>

#include "sil/task/kick_task.hpp"
#include "sil/world/planar_world.hpp"
#include "sil/world/world.hpp"
#include "training/task/state.hpp"

namespace striker::training {

// An action: what both wheels are set to.
struct SetPoints {
  double left_m_s = 0.0;
  double right_m_s = 0.0;
  bool operator==(const SetPoints&) const = default;
};

// Forward, stop, backward (paper, section IV.A).
[[nodiscard]] std::vector<SetPoints> kick_actions();

// The action that does the same seen in a mirror along the heading; -1 if there is none.
[[nodiscard]] int mirrored_action(const std::vector<SetPoints>& actions, int action);

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
  World world = World::fast;
  sil::PoseMode pose = sil::PoseMode::origin;
  Velocities velocities = Velocities::exact;
  Equations equations = Equations::corrected;
  StateInputs inputs = rcs_inputs();
  // The network sees the ball on the left only: where it is on the right, the situation is seen as in a
  // mirror along the heading, and an action swaps the wheels.
  bool mirrored = false;
  std::vector<SetPoints> actions = kick_actions();
  sil::KickRules rules = {};
  bool goes_on = false;  // the contact does not end the learner's episode
};

struct StepResult {
  double reward = 0.0;
  bool contact = false;  // the first contact was in this decision
  bool last = false;     // this was decision 40
  bool end = false;      // of the episode, for a learner
};

class KickEnv {
 public:
  explicit KickEnv(const EnvConfig& config);

  // To episode `episode` of `seed`.
  void reset(std::uint64_t seed, std::uint64_t episode);
  StepResult step(int action);  // up to 40 times after a reset
  void coast();                 // 100 ms with set-point 0

  [[nodiscard]] const EnvConfig& config() const { return config_; }
  [[nodiscard]] const Features& features() const { return features_; }  // what a network sees
  [[nodiscard]] const RcsState& state() const { return history_.ago(0).rcs; }
  [[nodiscard]] int decisions_left() const { return history_.ago(0).decisions_left; }
  [[nodiscard]] RawState raw() const { return raw_state(config_.inputs, history_, in_mirror()); }
  [[nodiscard]] const sil::KickOutcome& outcome() const { return episode_.outcome(); }
  [[nodiscard]] double simulated_s() const { return simulated_s_; }  // since it was made

 private:
  [[nodiscard]] bool in_mirror() const { return config_.mirrored && state().ball_y_m < 0.0; }
  void drive(const SetPoints& set_points, int steps);
  [[nodiscard]] Sight look() const;

  EnvConfig config_;
  std::variant<sil::PlanarWorld, sil::World> world_;
  sil::KickEpisode episode_;
  sil::Vec2 last_ball_m_;  // one vision frame ago
  History history_;
  sil::Random dummies_;
  Features features_;
  int decisions_ = 0;
  double simulated_s_ = 0.0;
};

using Choice = std::function<int(const KickEnv&)>;

// Plays an episode until the kick is measured, or to its end and 100 ms on, so that a late one is.
sil::KickOutcome play(KickEnv& env, std::uint64_t seed, std::uint64_t episode, const Choice& choose);

}  // namespace striker::training
