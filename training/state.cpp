#include "state.hpp"

#include <cmath>
#include <numbers>

namespace striker::training {

namespace {

constexpr double um_per_m = 1e6;
constexpr double mm_per_m = 1e3;
constexpr double half_circle = 32768.0;  // pi as a binary angle

std::int32_t rounded(double value) {
  return static_cast<std::int32_t>(std::lround(value));
}

// The binary angle wraps: pi and -pi are the same count.
std::int32_t binary_angle(double angle_rad) {
  return static_cast<std::int16_t>(std::lround(angle_rad / std::numbers::pi * half_circle));
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
  const bool at_rest = std::hypot(vx, vy) < rest_speed_m_s;
  const double angle_rad = at_rest ? 0.0 : std::atan2(vy, vx) - robot.heading_rad;
  state.ball_angle_rad = wrap_angle_rad(angle_rad);

  if (equations == Equations::printed) {
    state.robot_speed_m_s = robot_velocity.x * robot_velocity.x + robot_velocity.y * robot_velocity.y;
    state.ball_vx_m_s -= c * robot.x_m + s * robot.y_m;
    state.ball_vy_m_s -= -s * robot.x_m + c * robot.y_m;
    state.ball_angle_rad = angle_rad;
  }
  return state;
}

Features features(const RcsState& state) {
  return Eigen::Matrix<double, state_elements, 1>{
      state.ball_x_m / position_unit_m,       state.ball_y_m / position_unit_m,
      state.robot_speed_m_s / speed_unit_m_s, state.ball_vx_m_s / speed_unit_m_s,
      state.ball_vy_m_s / speed_unit_m_s,     state.ball_angle_rad / angle_unit_rad}
      .cast<float>();
}

Features mirrored(const Features& features) {
  static const Features signs{1.0F, -1.0F, 1.0F, 1.0F, -1.0F, -1.0F};
  return features.cwiseProduct(signs);
}

RawState raw_state(const RcsState& state) {
  return {rounded(state.ball_x_m * um_per_m),        rounded(state.ball_y_m * um_per_m),
          rounded(state.robot_speed_m_s * mm_per_m), rounded(state.ball_vx_m_s * mm_per_m),
          rounded(state.ball_vy_m_s * mm_per_m),     binary_angle(state.ball_angle_rad)};
}

RcsState state_of(const RawState& raw) {
  return {.ball_x_m = raw[0] / um_per_m,
          .ball_y_m = raw[1] / um_per_m,
          .robot_speed_m_s = raw[2] / mm_per_m,
          .ball_vx_m_s = raw[3] / mm_per_m,
          .ball_vy_m_s = raw[4] / mm_per_m,
          .ball_angle_rad = raw[5] / half_circle * std::numbers::pi};
}

}  // namespace striker::training
