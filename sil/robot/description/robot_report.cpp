// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/description/robot_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "firmware/can/messages/vision.hpp"
#include "firmware/core/slip_limiter.hpp"
#include "firmware/host/atomic_file.hpp"
#include "firmware/host/version.hpp"
#include "sil/world/physics_constants.hpp"

namespace striker::sil {

namespace {

constexpr double own_delay_s = 0.003;  // measurement, tick, and the drives' current loop

// The open loop is gain (kp + ki / s) / s with a delay: m/s of rim for the error in m/s.
struct OpenLoop {
  double gain_1_kg;  // 2 / (r m): the robot's acceleration for a N m on both wheels
  double kp;
  double ki;
  double delay_s;

  [[nodiscard]] double gain(double w_rad_s) const {
    return gain_1_kg * std::hypot(kp, ki / w_rad_s) / w_rad_s;
  }
  // What is left to half a turn.
  [[nodiscard]] double margin_rad(double w_rad_s) const {
    return std::numbers::pi / 2.0 - std::atan(ki / (kp * w_rad_s)) - w_rad_s * delay_s;
  }
};

// Where a falling function passes through zero: its logarithm is halved until a double has no more digits.
template <typename Function>
double root_rad_s(const Function& falling) {
  double low = 1e-2;
  double high = 1e5;
  for (int i = 0; i < 100; ++i) {
    const double middle = std::sqrt(low * high);
    (falling(middle) > 0.0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

DescribedFigures figures_of(const core::RobotDescription& robot) {
  const core::RobotProfile profile = core::profile_of(robot);
  const double radius_m = robot.wheel_radius_um / 1e6;
  DescribedFigures figures;
  figures.moved_mass_kg = (robot.body_mass_g + 3 * robot.wheel_mass_g) / 1e3;
  figures.acceleration_m_s2 = 2.0 * robot.torque_limit_mNm / 1e3 / (radius_m * figures.moved_mass_kg);
  figures.grip_m_s2 = robot.tyre_friction_percent / 1e2 * gravity_m_s2;
  figures.top_speed_m_s = robot.top_rim_speed_mm_s / 1e3;
  figures.time_to_top_s = figures.top_speed_m_s / figures.acceleration_m_s2;
  figures.way_to_top_m = 0.5 * figures.top_speed_m_s * figures.time_to_top_s;
  figures.turn_rate_rad_s = 2.0 * figures.top_speed_m_s / (robot.axle_length_um / 1e6);

  figures.kp_mNm_s_mm = profile.kp_q8 / 256.0;
  figures.ki_mNm_mm = profile.ki_tick_q16 / 65.536;
  const OpenLoop loop = {.gain_1_kg = 2.0 / (radius_m * figures.moved_mass_kg),
                         .kp = figures.kp_mNm_s_mm,
                         .ki = figures.ki_mNm_mm,
                         .delay_s = own_delay_s + robot.command_delay_ms / 2e3};
  figures.delay_ms = loop.delay_s * 1e3;
  figures.crossover_rad_s = root_rad_s([&](double w_rad_s) { return std::log(loop.gain(w_rad_s)); });
  figures.phase_margin_deg = loop.margin_rad(figures.crossover_rad_s) * 180.0 / std::numbers::pi;
  // The margin falls from where the delay outweighs the integral on; before that it is positive for these gains.
  figures.gain_margin = 1.0 / loop.gain(root_rad_s([&](double w_rad_s) {
    return w_rad_s < figures.crossover_rad_s ? 1.0 : loop.margin_rad(w_rad_s);
  }));

  figures.camera_rate_Hz = robot.camera_rate_Hz;
  figures.field_half_length_m = robot.field_half_length_mm / 1e3;
  figures.field_half_width_m = robot.field_half_width_mm / 1e3;
  figures.camera_latency_ms = robot.camera_latency_ms;
  figures.motion_ms = core::pictures_a_motion(profile) * 1e3 / robot.camera_rate_Hz;
  figures.velocity_step_mm_s = can::um_per_quarter_mm / figures.motion_ms;

  figures.slip_m_s2 =
      core::followed_gain_q8 / 256.0 * profile.slip_gain_q12 / 4096.0 * profile.torque_limit_mNm;
  figures.overspeed_m_s = profile.overspeed_mm_s / 1e3;
  return figures;
}

std::string robot_report(const DescribedFigures& figures) {
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("{:<14} {}\n", name, value);
  };
  line("moved mass", fmt::format("{:.3f} kg, with the wheels' spin", figures.moved_mass_kg));
  line("acceleration", fmt::format("{:.1f} m/s^2 at the torque limit; the tyres hold {:.1f} at most",
                                   figures.acceleration_m_s2, figures.grip_m_s2));
  line("top speed",
       fmt::format("{:.2f} m/s, after {:.0f} ms and {:.0f} mm; as much to stop", figures.top_speed_m_s,
                   figures.time_to_top_s * 1e3, figures.way_to_top_m * 1e3));
  line("turning", fmt::format("{:.1f} rad/s at most", figures.turn_rate_rad_s));
  line("wheel loops", fmt::format("kp {:.3f} mNm/(mm/s), ki {:.2f} mNm/mm: crossing over at {:.0f} rad/s",
                                  figures.kp_mNm_s_mm, figures.ki_mNm_mm, figures.crossover_rad_s));
  line("margins", fmt::format("{:.0f} degrees, and {:.1f} times the gain, with {:.1f} ms of delay",
                              figures.phase_margin_deg, figures.gain_margin, figures.delay_ms));
  line("camera",
       fmt::format("{:.0f} pictures a second, {:.0f} ms late; motion from two that are {:.1f} ms apart, in "
                   "steps of {:.1f} mm/s",
                   figures.camera_rate_Hz, figures.camera_latency_ms, figures.motion_ms,
                   figures.velocity_step_mm_s));
  line("slip",
       fmt::format("a wheel that gains more than {:.1f} m/s^2 is taken to have let go", figures.slip_m_s2));
  const auto border = [](double half_m) {
    return half_m > 0.0 ? fmt::format("+-{:.3f} m", half_m) : "nowhere";
  };
  line("field", fmt::format("kicks end before x {}, y {}", border(figures.field_half_length_m),
                            border(figures.field_half_width_m)));
  line("overspeed", fmt::format("not driven further from {:.2f} m/s on", figures.overspeed_m_s));
  if (figures.grip_m_s2 < figures.acceleration_m_s2) {
    text += "The torque is more than the tyres hold: wheels slip whenever it is all used.\n";
  }
  return text;
}

void write_robot_json(const DescribedFigures& figures, const std::string& source, bool policy_fits,
                      const std::filesystem::path& file) {
  nlohmann::ordered_json json = {{"source", source},
                                 {"moved_mass_kg", figures.moved_mass_kg},
                                 {"acceleration_m_s2", figures.acceleration_m_s2},
                                 {"grip_m_s2", figures.grip_m_s2},
                                 {"top_speed_m_s", figures.top_speed_m_s},
                                 {"time_to_top_s", figures.time_to_top_s},
                                 {"way_to_top_m", figures.way_to_top_m},
                                 {"turn_rate_rad_s", figures.turn_rate_rad_s},
                                 {"kp_mNm_s_mm", figures.kp_mNm_s_mm},
                                 {"ki_mNm_mm", figures.ki_mNm_mm},
                                 {"delay_ms", figures.delay_ms},
                                 {"crossover_rad_s", figures.crossover_rad_s},
                                 {"phase_margin_deg", figures.phase_margin_deg},
                                 {"gain_margin", figures.gain_margin},
                                 {"camera_rate_Hz", figures.camera_rate_Hz},
                                 {"camera_latency_ms", figures.camera_latency_ms},
                                 {"field_half_length_m", figures.field_half_length_m},
                                 {"field_half_width_m", figures.field_half_width_m},
                                 {"motion_ms", figures.motion_ms},
                                 {"velocity_step_mm_s", figures.velocity_step_mm_s},
                                 {"slip_m_s2", figures.slip_m_s2},
                                 {"overspeed_m_s", figures.overspeed_m_s},
                                 {"policy_fits", policy_fits}};
  host::stamp(json);
  host::AtomicFile out(file);
  out.write(json.dump(1) + '\n');
  out.finish();
}

}  // namespace striker::sil
