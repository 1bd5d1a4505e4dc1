// SPDX-License-Identifier: Apache-2.0
// What a network sees: a list of elements chosen in the configuration, each from the present decision or from
// one of those before it.
//
// The paper's RCS state (section III) is six elements in the robot's frame; its ACS state is ten in the
// field's axes. The corrected equations are the default. `printed` follows the paper to the letter, for
// comparison: the ball's velocity goes through M^-1 like a point (its third homogeneous component is 1), so
// the state depends on the robot's place; the robot's speed is the sum of squares, without a sign; the angle
// does not wrap.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "firmware/policy/policy.hpp"
#include "sil/world/random.hpp"
#include "sil/world/robot_specs.hpp"
#include "sil/world/world.hpp"
#include "training/task/recent.hpp"

namespace striker::training {

enum class Equations { corrected, printed };

// What a state is computed from, in the field's axes: the truth, or an estimate.
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

// All that one decision knows.
struct DecisionState {
  RcsState rcs;
  Observation field;
  int decisions_left = 0;  // 40 at the first decision of an episode, 0 after its last
};

// The first seven are the controller's, policy::StateElement in its order (state.cpp checks it against the
// firmware's own); the rest is for experiments.
enum class Element : std::uint8_t {
  ball_x,
  ball_y,
  robot_speed,
  ball_vx,
  ball_vy,
  ball_angle,
  decisions_left,
  field_robot_x,
  field_robot_y,
  field_robot_heading,
  field_robot_vx,
  field_robot_vy,
  field_ball_x,
  field_ball_y,
  field_ball_vx,
  field_ball_vy,
  field_ball_angle,
  dummy,  // uniform noise in -1 to 1, drawn anew at each decision
};

// A network reads value / unit. The controller's integer is value * raw_per_value, rounded.
struct ElementFacts {
  std::string_view name;
  double unit;  // SI: the circle on which the ball starts, the robot's steady speed, half a turn, ...
  double raw_per_value;  // um, mm/s, binary angle (2^16 is the full circle), decisions; 0: experiments only
  float mirror;          // factor of the value in a mirror along the heading; 0 if it has no mirror image
};

inline constexpr double position_unit_m = 2.0;
inline constexpr double speed_unit_m_s = sil::robot_spec(sil::Role::forward).max_rim_speed_m_s;
inline constexpr double angle_unit_rad = 3.14159265358979323846;

[[nodiscard]] const ElementFacts& facts_of(Element element);
[[nodiscard]] std::span<const ElementFacts> all_elements();

// One input of a network. Before the first decision of an episode everything was as at the first.
struct StateInput {
  Element element = Element::ball_x;
  int decisions_ago = 0;  // 0 to greatest_look_back
  bool operator==(const StateInput&) const = default;
};
inline constexpr int greatest_look_back = policy::greatest_look_back;

using StateInputs = std::vector<StateInput>;

[[nodiscard]] StateInputs rcs_inputs();  // the paper's RCS: six
[[nodiscard]] StateInputs acs_inputs();  // the paper's ACS: ten

// What the last decisions knew, the newest first.
class History {
 public:
  void begin(const DecisionState& first) { states_.fill(first); }
  void add(const DecisionState& newest) { states_.add(newest); }
  [[nodiscard]] const DecisionState& ago(int decisions) const {
    return states_.ago(static_cast<std::size_t>(decisions));
  }

 private:
  Recent<DecisionState, greatest_look_back + 1> states_;
};

using Features = Eigen::VectorXf;  // one value an input

// Writes into `features`, which has the inputs' size already; `mirror`: as seen in a mirror along the
// heading.
void write_features(const StateInputs& inputs, const History& history, bool mirror, sil::Random& dummies,
                    Features& features);

// The same situation seen in a mirror along the heading is the features times these factors, element by
// element. The task is symmetric: the reward stays.
[[nodiscard]] Features mirror_factors(const StateInputs& inputs);

// The controller's integers of the same inputs. No input may be for experiments only.
using RawState = std::vector<std::int32_t>;

[[nodiscard]] RawState raw_state(const StateInputs& inputs, const History& history, bool mirror = false);
[[nodiscard]] Features features_of(const StateInputs& inputs, std::span<const std::int32_t> raw);

}  // namespace striker::training
