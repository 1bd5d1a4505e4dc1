// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/ode_world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sil/world/field_specs.hpp"
#include "sil/world/ode/materials.hpp"
#include "sil/world/physics_constants.hpp"

namespace striker::sil {
namespace {

void init_ode() {
  static const bool ready = dInitODE2(0) != 0;
  if (!ready || dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll)) == 0) {
    throw std::runtime_error("ODE cannot be initialised: out of memory");
  }
}

}  // namespace

double kept_in_step(double step_s, double kept_a_second) {
  return std::pow(kept_a_second, step_s);
}

OdeWorld::OdeWorld(double step_s) {
  init_ode();
  threading_.reset(dThreadingAllocateSelfThreadedImplementation());
  world_.reset(dWorldCreate());
  dWorldID world = world_.get();
  dWorldSetStepThreadingImplementation(world, dThreadingImplementationGetFunctions(threading_.get()),
                                       threading_.get());
  const Softness softness = soften(world_softness, step_s);
  dWorldSetERP(world, softness.erp);
  dWorldSetCFM(world, softness.cfm);
  dWorldSetGravity(world, 0.0, 0.0, -gravity_m_s2);
  dWorldSetDamping(world, 1.0 - kept_in_step(step_s), 1.0 - kept_in_step(step_s));
  dWorldSetLinearDampingThreshold(world, 0.0);
  dWorldSetAngularDampingThreshold(world, 0.0);
}

void OdeWorld::reserve(std::size_t rows) {
  // The matrix of the rows' effects on each other, its factors and lists.
  constexpr std::size_t matrices = 4;
  dWorldStepReserveInfo memory{};
  memory.struct_size = sizeof(memory);
  memory.reserve_factor = dWORLDSTEP_RESERVEFACTOR_DEFAULT;
  memory.reserve_minimum = static_cast<unsigned>(matrices * rows * rows * sizeof(dReal));
  dWorldSetStepMemoryReservationPolicy(world_.get(), &memory);
}

Ball make_ball(dWorldID world, double kept_a_second, double step_s) {
  Ball ball{.body = dBodyCreate(world), .geom = GeomHandle(dCreateSphere(nullptr, ball_radius_m))};
  dMass mass;
  dMassSetSphereTotal(&mass, ball_mass_kg, ball_radius_m);
  dBodySetMass(ball.body, &mass);
  dGeomSetBody(ball.geom.get(), ball.body);
  dBodySetLinearDamping(ball.body, 1.0 - kept_in_step(step_s, kept_a_second));
  dBodySetAngularDamping(ball.body, 1.0 - kept_in_step(step_s, kept_a_second));
  return ball;
}

void place(const Ball& ball, const BallState& state) {
  // The depth at which the floor's spring carries the ball.
  constexpr double weight_N = gravity_m_s2 * ball_mass_kg;
  const double height_m = ball_radius_m - weight_N / spring_N_m(world_softness);
  const dQuaternion upright = {1.0, 0.0, 0.0, 0.0};
  dBodySetPosition(ball.body, state.position_m.x, state.position_m.y, height_m);
  dBodySetQuaternion(ball.body, upright);
  dBodySetLinearVel(ball.body, state.velocity_m_s.x, state.velocity_m_s.y, 0.0);
  dBodySetAngularVel(ball.body, -state.velocity_m_s.y / ball_radius_m, state.velocity_m_s.x / ball_radius_m,
                     0.0);
  dBodySetForce(ball.body, 0.0, 0.0, 0.0);
  dBodySetTorque(ball.body, 0.0, 0.0, 0.0);
}

void drop(const Ball& ball, Vec2 position_m, double height_m) {
  place(ball, {.position_m = position_m, .velocity_m_s = {}});
  const double lying_m = dBodyGetPosition(ball.body)[2];
  dBodySetPosition(ball.body, position_m.x, position_m.y, std::max(height_m, lying_m));
}

BallState state_of(const Ball& ball) {
  const dReal* position = dBodyGetPosition(ball.body);
  const dReal* velocity = dBodyGetLinearVel(ball.body);
  return {.position_m = {position[0], position[1]}, .velocity_m_s = {velocity[0], velocity[1]}};
}

Vec2 ball_friction_axis(const Ball& ball) {
  constexpr double rolling_m_s = 1e-3;
  const dReal* velocity = dBodyGetLinearVel(ball.body);
  const dReal* spin = dBodyGetAngularVel(ball.body);
  const Vec2 slip{velocity[0] - ball_radius_m * spin[1], velocity[1] + ball_radius_m * spin[0]};
  return std::hypot(slip.x, slip.y) > rolling_m_s ? slip : Vec2{velocity[0], velocity[1]};
}

Vec2 contact_direction(const dContactGeom& contact, dBodyID robot, dBodyID ball) {
  Vec2 direction{-contact.normal[0], -contact.normal[1]};
  if (std::hypot(direction.x, direction.y) < 1e-6) {
    const dReal* from = dBodyGetPosition(robot);
    const dReal* to = dBodyGetPosition(ball);
    direction = {to[0] - from[0], to[1] - from[1]};
  }
  const double length = std::hypot(direction.x, direction.y);
  return length > 0.0 ? Vec2{direction.x / length, direction.y / length} : Vec2{1.0, 0.0};
}

}  // namespace striker::sil
