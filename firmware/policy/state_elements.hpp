// SPDX-License-Identifier: Apache-2.0
// The elements of state that a policy can read, in the robot's frame (RCS, the paper's section III), and the
// controller's integer unit of each. The controller, the exporter and the decision CSV read this table; the
// trainer's, which has more elements, is checked against it by the compiler.
//
// A new element is an enumerator and a row here, and its value in firmware/core/estimation/relative_state.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace striker::policy {

enum class StateElement : std::uint8_t {
  ball_x = 0,          // um
  ball_y = 1,          // um
  robot_speed = 2,     // mm/s, signed along the heading
  ball_vx = 3,         // mm/s, a direction: rotated, not translated
  ball_vy = 4,         // mm/s
  ball_angle = 5,      // of the ball's movement: binary angle, 2^16 is the full circle, in [-32768, 32767]
  decisions_left = 6,  // of the 40 that a kick has, counted down from the first one after arming, to 0
};

struct StateElementRow {
  StateElement element;
  std::string_view name;    // in configurations and headers
  std::string_view column;  // in CSV files: the name with the controller's unit
  bool changes_sign;        // in a mirror along the heading
};

inline constexpr std::array<StateElementRow, 7> state_elements = {{
    {StateElement::ball_x, "ball_x", "ball_x_um", false},
    {StateElement::ball_y, "ball_y", "ball_y_um", true},
    {StateElement::robot_speed, "robot_speed", "robot_speed_mm_s", false},
    {StateElement::ball_vx, "ball_vx", "ball_vx_mm_s", false},
    {StateElement::ball_vy, "ball_vy", "ball_vy_mm_s", true},
    {StateElement::ball_angle, "ball_angle", "ball_angle", true},
    {StateElement::decisions_left, "decisions_left", "decisions_left", false},
}};

static_assert(state_elements.size() == static_cast<std::size_t>(StateElement::decisions_left) + 1);
static_assert(
    [] {
      for (std::size_t i = 0; i < state_elements.size(); ++i) {
        if (state_elements[i].element != static_cast<StateElement>(i)) {
          return false;
        }
      }
      return true;
    }(),
    "the table is in the order of the enumeration");

[[nodiscard]] constexpr const StateElementRow& row_of(StateElement element) {
  return state_elements[static_cast<std::size_t>(element)];
}

[[nodiscard]] constexpr bool changes_sign(StateElement element) {
  return row_of(element).changes_sign;
}

}  // namespace striker::policy
