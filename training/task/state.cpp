// SPDX-License-Identifier: Apache-2.0
#include "training/task/state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace striker::training {

namespace {

constexpr double um_per_m = 1e6;
constexpr double mm_per_m = 1e3;
constexpr double counts_per_rad = 32768.0 / angle_unit_rad;
constexpr double field_unit_m = 4.0;  // about half the field's length
constexpr double episode_unit = policy::decisions_a_kick;

// In the order of Element.
constexpr std::array<ElementFacts, 18> facts = {{
    {"ball_x", position_unit_m, um_per_m, 1.0F},
    {"ball_y", position_unit_m, um_per_m, -1.0F},
    {"robot_speed", speed_unit_m_s, mm_per_m, 1.0F},
    {"ball_vx", speed_unit_m_s, mm_per_m, 1.0F},
    {"ball_vy", speed_unit_m_s, mm_per_m, -1.0F},
    {"ball_angle", angle_unit_rad, counts_per_rad, -1.0F},
    {"decisions_left", episode_unit, 1.0, 1.0F},
    {"field_robot_x", field_unit_m, 0.0, 0.0F},
    {"field_robot_y", field_unit_m, 0.0, 0.0F},
    {"field_robot_heading", angle_unit_rad, 0.0, 0.0F},
    {"field_robot_vx", speed_unit_m_s, 0.0, 0.0F},
    {"field_robot_vy", speed_unit_m_s, 0.0, 0.0F},
    {"field_ball_x", field_unit_m, 0.0, 0.0F},
    {"field_ball_y", field_unit_m, 0.0, 0.0F},
    {"field_ball_vx", speed_unit_m_s, 0.0, 0.0F},
    {"field_ball_vy", speed_unit_m_s, 0.0, 0.0F},
    {"field_ball_angle", angle_unit_rad, 0.0, 0.0F},
    {"dummy", 1.0, 0.0, 1.0F},
}};

// The firmware computes these itself: the numbers in an exported header are its own, and so are the mirror's
// signs.
constexpr bool is_the_firmwares(Element element, policy::StateElement of_firmware) {
  return static_cast<int>(element) == static_cast<int>(of_firmware) &&
         facts[static_cast<std::size_t>(element)].name == policy::row_of(of_firmware).name &&
         (facts[static_cast<std::size_t>(element)].mirror < 0.0F) == policy::changes_sign(of_firmware) &&
         facts[static_cast<std::size_t>(element)].raw_per_value != 0.0;
}
static_assert(is_the_firmwares(Element::ball_x, policy::StateElement::ball_x));
static_assert(is_the_firmwares(Element::ball_y, policy::StateElement::ball_y));
static_assert(is_the_firmwares(Element::robot_speed, policy::StateElement::robot_speed));
static_assert(is_the_firmwares(Element::ball_vx, policy::StateElement::ball_vx));
static_assert(is_the_firmwares(Element::ball_vy, policy::StateElement::ball_vy));
static_assert(is_the_firmwares(Element::ball_angle, policy::StateElement::ball_angle));
static_assert(is_the_firmwares(Element::decisions_left, policy::StateElement::decisions_left));
static_assert(facts[static_cast<std::size_t>(Element::decisions_left) + 1].raw_per_value == 0.0,
              "the controller has seven elements");

// The longer component alone says it of most movements.
bool is_at_rest(sil::Vec2 velocity_m_s) {
  const auto [vx, vy] = velocity_m_s;
  return std::max(std::abs(vx), std::abs(vy)) < rest_speed_m_s && std::hypot(vx, vy) < rest_speed_m_s;
}

double direction_rad(sil::Vec2 velocity_m_s) {
  return is_at_rest(velocity_m_s) ? 0.0 : std::atan2(velocity_m_s.y, velocity_m_s.x);
}

double value_of(Element element, const DecisionState& state, sil::Random& dummies) {
  const RcsState& rcs = state.rcs;
  const Observation& field = state.field;
  switch (element) {
    case Element::ball_x:
      return rcs.ball_x_m;
    case Element::ball_y:
      return rcs.ball_y_m;
    case Element::robot_speed:
      return rcs.robot_speed_m_s;
    case Element::ball_vx:
      return rcs.ball_vx_m_s;
    case Element::ball_vy:
      return rcs.ball_vy_m_s;
    case Element::ball_angle:
      return rcs.ball_angle_rad;
    case Element::decisions_left:
      return state.decisions_left;
    case Element::field_robot_x:
      return field.robot.x_m;
    case Element::field_robot_y:
      return field.robot.y_m;
    case Element::field_robot_heading:
      return field.robot.heading_rad;
    case Element::field_robot_vx:
      return field.robot_velocity_m_s.x;
    case Element::field_robot_vy:
      return field.robot_velocity_m_s.y;
    case Element::field_ball_x:
      return field.ball.position_m.x;
    case Element::field_ball_y:
      return field.ball.position_m.y;
    case Element::field_ball_vx:
      return field.ball.velocity_m_s.x;
    case Element::field_ball_vy:
      return field.ball.velocity_m_s.y;
    case Element::field_ball_angle:
      return direction_rad(field.ball.velocity_m_s);
    case Element::dummy:
      return dummies.uniform(-1.0, 1.0);
  }
  return 0.0;
}

StateInputs range(Element first, Element last) {
  StateInputs inputs;
  for (auto element = static_cast<int>(first); element <= static_cast<int>(last); ++element) {
    inputs.push_back({.element = static_cast<Element>(element)});
  }
  return inputs;
}

}  // namespace

double wrap_angle_rad(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

RcsState rcs_state(const Observation& observation, Equations equations) {
  const auto& [robot, robot_velocity, ball] = observation;
  const double c = std::cos(robot.heading_rad);
  const double s = std::sin(robot.heading_rad);
  const double dx = ball.position_m.x - robot.x_m;
  const double dy = ball.position_m.y - robot.y_m;
  const auto [vx, vy] = ball.velocity_m_s;

  RcsState state;
  state.ball_x_m = c * dx + s * dy;
  state.ball_y_m = -s * dx + c * dy;
  state.robot_speed_m_s = c * robot_velocity.x + s * robot_velocity.y;
  state.ball_vx_m_s = c * vx + s * vy;
  state.ball_vy_m_s = -s * vx + c * vy;
  const double angle_rad = is_at_rest(ball.velocity_m_s) ? 0.0 : std::atan2(vy, vx) - robot.heading_rad;
  state.ball_angle_rad = wrap_angle_rad(angle_rad);

  if (equations == Equations::printed) {
    state.robot_speed_m_s = robot_velocity.x * robot_velocity.x + robot_velocity.y * robot_velocity.y;
    state.ball_vx_m_s -= c * robot.x_m + s * robot.y_m;
    state.ball_vy_m_s -= -s * robot.x_m + c * robot.y_m;
    state.ball_angle_rad = angle_rad;
  }
  return state;
}

const ElementFacts& facts_of(Element element) {
  return facts.at(static_cast<std::size_t>(element));
}

std::span<const ElementFacts> all_elements() {
  return facts;
}

StateInputs rcs_inputs() {
  return range(Element::ball_x, Element::ball_angle);
}

StateInputs acs_inputs() {
  return range(Element::field_robot_x, Element::field_ball_angle);
}

void write_features(const StateInputs& inputs, const History& history, bool mirror, sil::Random& dummies,
                    Features& features) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto [element, ago] = inputs[i];
    const ElementFacts& about = facts_of(element);
    const auto value = static_cast<float>(value_of(element, history.ago(ago), dummies) / about.unit);
    features[static_cast<Eigen::Index>(i)] = mirror ? about.mirror * value : value;
  }
}

Features mirror_factors(const StateInputs& inputs) {
  Features factors(inputs.size());
  std::transform(inputs.begin(), inputs.end(), factors.begin(),
                 [](const StateInput& input) { return facts_of(input.element).mirror; });
  return factors;
}

RawState raw_state(const StateInputs& inputs, const History& history, bool mirror) {
  RawState raw;
  raw.reserve(inputs.size());
  sil::Random none(0, 0, 0);
  for (const auto& [element, ago] : inputs) {
    const double value = value_of(element, history.ago(ago), none) * facts_of(element).raw_per_value;
    const auto rounded = static_cast<std::int32_t>(std::lround(value));
    // The binary angle wraps: pi and -pi are the same count.
    const std::int32_t stored = element == Element::ball_angle ? static_cast<std::int16_t>(rounded) : rounded;
    raw.push_back(mirror && facts_of(element).mirror < 0.0F ? -stored : stored);
  }
  return raw;
}

Features features_of(const StateInputs& inputs, std::span<const std::int32_t> raw) {
  Features features(inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const ElementFacts& element = facts_of(inputs[i].element);
    features[static_cast<Eigen::Index>(i)] =
        static_cast<float>(raw[i] / element.raw_per_value / element.unit);
  }
  return features;
}

}  // namespace striker::training
