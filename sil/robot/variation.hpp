// SPDX-License-Identifier: Apache-2.0
// How a robot, its ball and its signals differ from what the controller was told: nobody measures a mass to the
// per cent. The controller keeps its description; the world gets the varied one.
//
//   striker-sil kick --vary mass=0.9,friction=0.5,vision_latency_ms=35
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/robot_profile.hpp"
#include "sil/robot/camera.hpp"
#include "sil/robot/plant.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

struct Variation {
  // Shares of what is described.
  double mass = 1.0;    // of body and wheels
  double torque = 1.0;  // that the motors give for what they are told, and of their limit
  double friction = 1.0;
  double ball_damping = 1.0;  // of its rate

  double vision_noise_mm = 0.0;  // standard deviation of each coordinate of robot and ball
  // Nothing: as described.
  std::optional<std::uint32_t> vision_latency_ms = {};  // from the picture to its frames
  std::optional<std::uint32_t> command_delay_ms = {};   // from the command's frame to the motors
  std::optional<std::uint32_t> camera_rate_Hz = {};

  bool operator==(const Variation&) const = default;
};

// From "mass=0.9,torque=1.1". Throws std::runtime_error that names what is wrong and what there is.
[[nodiscard]] Variation variation_of(const std::string& text);

// With the description's delays and rate for those that are not varied.
[[nodiscard]] Variation completed(Variation variation, const core::RobotDescription& described);

[[nodiscard]] RobotSpec varied(const RobotSpec& described, const Variation& variation);

// Of its speed, what damping leaves AI Soccer's ball.
[[nodiscard]] double ball_kept_after_1_s(const Variation& variation);

// The described robot's motors, and around them what varies them: each holds the one before it, the last is to be used.
[[nodiscard]] std::vector<std::unique_ptr<Plant>> make_plants(PlantKind kind, const RobotSpec& described,
                                                              const Variation& variation);

// Of robot 0. The seed is of the noise.
[[nodiscard]] std::unique_ptr<Camera> make_camera(const Variation& variation, std::uint64_t seed);

}  // namespace striker::sil
