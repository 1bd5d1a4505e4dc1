// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/materials.hpp"

#include <array>

#include "sil/world/physics_constants.hpp"

namespace striker::sil {
namespace {

struct Material {
  double mu;
  double bounce;
  Softness softness;
};

// In the order of Pair. Where AI Soccer leaves mu or bounce out, the defaults of Webots hold: 1 and 0.5.
constexpr std::array<Material, pair_count> materials = {{
    {.mu = 0.0, .bounce = 0.0, .softness = {.erp = 0.15, .cfm = 1e-5}},  // floor_body: also the skids
    {.mu = tyre_friction, .bounce = 0.0, .softness = {.erp = 0.15, .cfm = 1e-5}},  // floor_wheel
    {.mu = 0.1, .bounce = 0.0, .softness = {.erp = 0.15, .cfm = 1e-5}},            // floor_ball
    {.mu = 1.0, .bounce = 0.0, .softness = {.erp = 0.0, .cfm = 1e-5}},             // wall_body
    {.mu = 1.0, .bounce = 0.75, .softness = {.erp = 1.0, .cfm = 0.0}},             // wall_ball
    {.mu = 1.0, .bounce = 0.25, .softness = {.erp = 0.0, .cfm = 1e-7}},            // body_body
    {.mu = 1.0, .bounce = 0.5, .softness = {.erp = 0.15, .cfm = 1e-5}},            // goalkeeper_ball
    {.mu = 1.0, .bounce = 0.8, .softness = {.erp = 0.15, .cfm = 1e-5}},            // body_ball
    {.mu = 1.0, .bounce = 0.0, .softness = {.erp = 0.0, .cfm = 1e-7}},             // held_wall_ball
    {.mu = 1.0, .bounce = 0.0, .softness = {.erp = 0.15, .cfm = 1e-5}},            // held_body_ball
}};

}  // namespace

double spring_N_m(const Softness& at_reference_step) {
  return at_reference_step.erp / (reference_step_s * at_reference_step.cfm);
}

Softness soften(const Softness& at_reference_step, double step_s) {
  if (at_reference_step.cfm == 0.0 || step_s == reference_step_s) {
    return at_reference_step;
  }
  const double kp = spring_N_m(at_reference_step);
  const double kd = (1.0 - at_reference_step.erp) / at_reference_step.cfm;
  const double stiffness = step_s * kp + kd;
  return {.erp = step_s * kp / stiffness, .cfm = 1.0 / stiffness};
}

dSurfaceParameters surface(Pair pair, double step_s) {
  const Material& material = materials.at(static_cast<std::size_t>(pair));
  const Softness softness = soften(material.softness, step_s);
  dSurfaceParameters parameters{};
  parameters.mode = dContactSoftERP | dContactSoftCFM | dContactApprox1;
  parameters.mu = material.mu;
  parameters.soft_erp = softness.erp;
  parameters.soft_cfm = softness.cfm;
  if (material.bounce > 0.0) {
    parameters.mode |= dContactBounce;
    parameters.bounce = material.bounce;
    parameters.bounce_vel = bounce_threshold_m_s;
  }
  return parameters;
}

}  // namespace striker::sil
