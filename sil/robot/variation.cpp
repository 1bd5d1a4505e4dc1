// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/variation.hpp"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string_view>

#include "sil/robot/plant_variation.hpp"
#include "sil/world/random.hpp"
#include "sil/world/random_streams.hpp"

namespace striker::sil {

namespace {

struct Share {
  std::string_view name;
  double Variation::*member;
  double least;
  double greatest;
};
constexpr std::array shares = {Share{"mass", &Variation::mass, 0.2, 5.0},
                               Share{"torque", &Variation::torque, 0.2, 5.0},
                               Share{"friction", &Variation::friction, 0.05, 5.0},
                               Share{"ball_damping", &Variation::ball_damping, 0.0, 10.0},
                               Share{"vision_noise_mm", &Variation::vision_noise_mm, 0.0, 50.0}};

struct Whole {
  std::string_view name;
  std::optional<std::uint32_t> Variation::*member;
  double least;
  double greatest;
};
// A picture later than 50 ms would be one of the episode before.
constexpr std::array wholes = {Whole{"vision_latency_ms", &Variation::vision_latency_ms, 0.0, 50.0},
                               Whole{"command_delay_ms", &Variation::command_delay_ms, 0.0, 50.0},
                               Whole{"camera_rate_Hz", &Variation::camera_rate_Hz, 10.0, 100.0}};

double number_of(std::string_view name, std::string_view text, double least, double greatest) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= least && value <= greatest)) {
    throw std::runtime_error(fmt::format("{}={}: give a number from {} to {}", name, text, least, greatest));
  }
  return value;
}

void set(Variation& variation, std::string_view name, std::string_view value) {
  for (const Share& share : shares) {
    if (share.name == name) {
      variation.*share.member = number_of(name, value, share.least, share.greatest);
      return;
    }
  }
  for (const Whole& whole : wholes) {
    if (whole.name == name) {
      const double number = number_of(name, value, whole.least, whole.greatest);
      if (number != std::floor(number)) {
        throw std::runtime_error(fmt::format("{}={}: give a whole number", name, value));
      }
      variation.*whole.member = static_cast<std::uint32_t>(number);
      return;
    }
  }
  throw std::runtime_error(
      fmt::format("{}: there is mass, torque, friction, ball_damping (shares: 0.9 is 10 % less), "
                  "vision_noise_mm, vision_latency_ms, command_delay_ms and camera_rate_Hz",
                  name));
}

// Gaussian noise on each coordinate.
class NoisyCamera final : public Camera {
 public:
  NoisyCamera(double noise_m, std::uint64_t seed)
      : exact_(0), noise_m_(noise_m), random_(seed, 0, random_stream::camera_noise) {}

  [[nodiscard]] Picture look(const World& world) override {
    Picture picture = exact_.look(world);
    picture.robot.x_m += draw();
    picture.robot.y_m += draw();
    picture.ball_m.x += draw();
    picture.ball_m.y += draw();
    return picture;
  }

 private:
  double draw() { return noise_m_ * normal(random_); }

  ExactCamera exact_;
  double noise_m_;
  Random random_;
};

}  // namespace

Variation variation_of(const std::string& text) {
  Variation variation;
  if (text.empty()) {
    return variation;
  }
  std::set<std::string_view> named;
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    const std::string_view part = rest.substr(0, comma);
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) {
      throw std::runtime_error(fmt::format("{}: '{}' is no NAME=VALUE, as mass=0.9", text, part));
    }
    const std::string_view name = part.substr(0, equals);
    if (!named.insert(name).second) {
      throw std::runtime_error(fmt::format("{}: {} is named twice", text, name));
    }
    set(variation, name, part.substr(equals + 1));
    if (comma == std::string_view::npos) {
      return variation;
    }
    rest.remove_prefix(comma + 1);
  }
}

Variation completed(Variation variation, const core::RobotDescription& described) {
  const auto whole = [](std::int32_t number) { return static_cast<std::uint32_t>(number); };
  variation.vision_latency_ms = variation.vision_latency_ms.value_or(whole(described.camera_latency_ms));
  variation.command_delay_ms = variation.command_delay_ms.value_or(whole(described.command_delay_ms));
  variation.camera_rate_Hz = variation.camera_rate_Hz.value_or(whole(described.camera_rate_Hz));
  return variation;
}

RobotSpec varied(const RobotSpec& described, const Variation& variation) {
  RobotSpec robot = described;
  robot.body_mass_kg *= variation.mass;
  robot.wheel_mass_kg *= variation.mass;
  robot.tyre_friction *= variation.friction;
  robot.max_wheel_torque_Nm *= variation.torque;
  return robot;
}

double ball_kept_after_1_s(const Variation& variation) {
  return std::pow(kept_after_1_s, variation.ball_damping);
}

std::vector<std::unique_ptr<Plant>> make_plants(PlantKind kind, const RobotSpec& described,
                                                const Variation& variation) {
  RobotSpec spec = described;
  spec.max_wheel_torque_Nm *= variation.torque;
  std::vector<std::unique_ptr<Plant>> plants;
  plants.push_back(make_plant(kind, 0, spec));
  if (variation.torque != 1.0) {
    plants.push_back(std::make_unique<ScaledPlant>(*plants.back(), variation.torque));
  }
  const std::uint32_t delay_ms = variation.command_delay_ms.value_or(0);
  if (delay_ms != 0) {
    plants.push_back(std::make_unique<LatePlant>(*plants.back(), delay_ms));
  }
  return plants;
}

std::unique_ptr<Camera> make_camera(const Variation& variation, std::uint64_t seed) {
  if (variation.vision_noise_mm == 0.0) {
    return std::make_unique<ExactCamera>(0);
  }
  return std::make_unique<NoisyCamera>(variation.vision_noise_mm * 1e-3, seed);
}

}  // namespace striker::sil
