// SPDX-License-Identifier: Apache-2.0
// The official kick task: one definition for training, evaluation and SIL.
//
// An open floor, one forward robot, 40 decisions of 50 ms. The ball starts on the circle of 2 m around the
// robot and rolls towards a point near the robot; the target lies in the direction of the robot's initial
// heading, at infinity. Reward (paper, section IV.A): -0.1 for each decision without contact so far; the
// decision of the contact gets 3 cos(theta_contact) + 3.92 V_contact; 0 after. Without contact: -4.
//
// The aimed kick is the same but for what the contact gets: 2 (v_along - |v_across|), not below -4, of the ball's
// velocity 100 ms after it, along the target's direction and across, while the decision of the contact holds on.
#pragma once

#include <cstdint>

#include "firmware/core/tick.hpp"
#include "firmware/policy/policy.hpp"
#include "sil/task/kick_world.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

inline constexpr int kick_decisions = policy::decisions_a_kick;
inline constexpr int decision_period_ms = core::decision_period_ms;  // the AI Soccer frame
inline constexpr double decision_period_s = decision_period_ms / 1000.0;

enum class PoseMode { origin, anywhere };

// What the contact is paid for: where and how fast the robot met the ball (the paper's), or how the ball leaves.
enum class KickReward { contact, aimed };

// What the paper leaves open, or a user's own task changes. The defaults are the official task.
struct KickRules {
  double slowest_ball_m_s = 1.0;
  double fastest_ball_m_s = 3.0;
  double aim_radius_m = 0.5;  // around the robot's centre
  double waiting_reward = -0.1;
  double angle_reward = 3.0;
  double speed_reward_s_m = 3.92;
  bool signed_speed = true;    // V_contact is negative when the robot drives backward
  bool every_contact = false;  // each decision with a contact is paid, not only the first one's
  KickReward reward = KickReward::contact;
};

// From the contact's step to the ball's measurement.
inline constexpr int measured_after_ms = 100;
inline constexpr double measured_after_s = measured_after_ms / 1000.0;

// What the aimed kick pays for the ball's velocity then.
[[nodiscard]] double aimed_reward(Vec2 ball_velocity_m_s, double target_heading_rad);

struct KickStart {
  Pose robot;
  BallState ball;
};

// Episode i is a pure function of (seed, i), drawn in the robot's frame; the pose comes from a stream of its
// own, so that it changes nothing else.
[[nodiscard]] KickStart draw_kick(std::uint64_t seed, std::uint64_t episode, PoseMode pose,
                                  const KickRules& rules = {});

// The ball `ahead_s` seconds before the start, led back along its path kinematically: what a camera would
// have seen of an episode that begins at `start`.
[[nodiscard]] BallState ball_before(const KickStart& start, double ahead_s);

// The robot and the ball that the task is played with. The defaults are the official ones.
struct KickPlace {
  RobotSpec robot = robot_spec(Role::forward);
  double ball_kept_after_1_s = kept_after_1_s;  // of its speed: 0.8 in AI Soccer
};

// The world that the task is played in, at this physics step.
[[nodiscard]] WorldConfig kick_world(double step_s, const KickPlace& place = {});

struct KickOutcome {
  bool contact = false;
  int contact_decision = -1;       // 0 to 39
  double theta_contact_rad = 0.0;  // from the target's direction to the line robot centre -> ball centre
  double v_contact_m_s = 0.0;      // the robot's speed along its heading, signed
  bool front_face = false;         // the contact was on the front face
  double reward = 0.0;             // the sum so far
  bool ball_measured = false;      // 100 ms have passed since the contact
  double ball_speed_m_s = 0.0;     // 100 ms after the contact
  double ball_angle_rad = 0.0;     // of the ball's movement against the target's direction, then
  bool kicked = false;             // front face, then within 15 degrees at more than 1 m/s
};

// Watches one episode. The caller drives the wheels, and steps the world through `step` only:
//   begin, then 40 times: (steps of 50 ms in all, end_decision), then steps of 100 ms to see the ball leave.
// An aimed contact's decision is paid by end_decision if the ball is measured by then, and else the outcome's sum only,
// when it is: who wants its reward from end_decision makes the decision last so long.
class KickEpisode {
 public:
  explicit KickEpisode(const KickRules& rules = {}) : rules_(rules) {}

  template <KickWorld W>
  void begin(W& world, const KickStart& start);  // places robot and ball
  template <KickWorld W>
  void step(W& world);
  double end_decision();  // the reward of the decision that ends here
  [[nodiscard]] const KickOutcome& outcome() const { return outcome_; }

 private:
  void measure_ball(Vec2 velocity_m_s);

  KickRules rules_;
  double target_heading_rad_ = 0.0;
  int decision_ = 0;
  int steps_to_measurement_ = 0;
  bool contact_due_ = false;  // this decision had a contact that pays
  double contact_reward_ = 0.0;
  KickOutcome outcome_;
};

}  // namespace striker::sil
