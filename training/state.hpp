// What the policy sees: the paper's RCS state (section III), six elements in the robot's frame.
//
// The corrected form is the default. `printed` follows the paper's equations to the letter, for comparison:
// the ball's velocity goes through M^-1 like a point (its third homogeneous component is 1), so the state
// depends on the robot's place; the robot's speed is the sum of squares, without a sign; the angle does not
// wrap.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "world/world.hpp"

namespace striker::training {

enum class Equations { corrected, printed };

// What a state is computed from, in world axes: the truth, or an estimate.
struct Observation {
  sil::Pose robot;
  sil::Vec2 robot_velocity_m_s;
  sil::BallState ball;
};

struct RcsState {
  double ball_x_m = 0.0;  // the ball's centre seen from the robot's centre, x' along the heading
  double ball_y_m = 0.0;
  double robot_speed_m_s = 0.0;  // along the heading, signed
  double ball_vx_m_s = 0.0;      // over the floor, not relative to the robot's velocity
  double ball_vy_m_s = 0.0;
  double ball_angle_rad = 0.0;  // of the ball's movement against the heading, in (-pi, pi]
};

// Below this speed the ball counts as at rest, and the direction of its movement is defined as 0.
inline constexpr double rest_speed_m_s = 0.02;

[[nodiscard]] RcsState rcs_state(const Observation& observation, Equations equations);

[[nodiscard]] double wrap_angle_rad(double angle_rad);  // into (-pi, pi]

// The network reads each element divided by one of these: the circle on which the ball starts, the robot's
// steady speed, half a turn.
inline constexpr double position_unit_m = 2.0;
inline constexpr double speed_unit_m_s = 2.55;
inline constexpr double angle_unit_rad = 3.14159265358979323846;

inline constexpr int state_elements = 6;
using Features = Eigen::Matrix<float, state_elements, 1>;

[[nodiscard]] Features features(const RcsState& state);

// The same situation seen in a mirror along the heading. The task is symmetric: reward and best action stay.
[[nodiscard]] Features mirrored(const Features& features);

// The state in the firmware's integers: um, mm/s and a binary angle (2^16 is the full circle), rounded.
using RawState = std::array<std::int32_t, state_elements>;

[[nodiscard]] RawState raw_state(const RcsState& state);
[[nodiscard]] RcsState state_of(const RawState& raw);

}  // namespace striker::training
