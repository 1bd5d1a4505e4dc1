// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "sil/world/ode/box_contacts.hpp"

namespace striker::sil {
namespace {

constexpr double shortest_axis = 1e-6;

// A tilted box needs its contacts above each other: they are what stops it from tilting further, into a wall. What
// has no body never tilts. Cosine of 8 degrees.
bool is_upright(dGeomID geom) {
  constexpr double upright = 0.99;
  constexpr std::size_t up_z = 10;  // of ODE's rotation: row z, column z
  return dGeomGetBody(geom) == nullptr || dGeomGetRotation(geom)[up_z] > upright;
}

}  // namespace

Contacts::Contacts(dWorldID world, double step_s)
    : world_(world), step_s_(step_s), joints_(dJointGroupCreate(0)) {
  for (std::size_t i = 0; i < pair_count; ++i) {
    surfaces_.at(i) = surface(static_cast<Pair>(i), step_s);
  }
}

void Contacts::reserve(int contacts) {
  const dContact nothing{};
  for (int i = 0; i < contacts; ++i) {
    dJointCreateContact(world_, joints_.get(), &nothing);
  }
  dJointGroupEmpty(joints_.get());
}

std::span<const dContactGeom> Contacts::collide(dGeomID a, dGeomID b, Pair pair,
                                                const SpecialContact& special) {
  const std::span<const dContactGeom> geoms = find(a, b);
  dContact contact{};
  contact.surface = surfaces_[static_cast<std::size_t>(pair)];
  contact.surface.mu = special.friction.value_or(contact.surface.mu);
  const double soft_erp = contact.surface.soft_erp;
  const double soft_cfm = contact.surface.soft_cfm;
  const double length = std::hypot(special.friction_axis.x, special.friction_axis.y);
  if (length > shortest_axis) {
    contact.surface.mode |= dContactFDir1;
    contact.fdir1[0] = special.friction_axis.x / length;
    contact.fdir1[1] = special.friction_axis.y / length;
  }
  for (const dContactGeom& geom : geoms) {
    contact.geom = geom;
    contact.surface.soft_cfm = soft_cfm;
    contact.surface.soft_erp = std::min(soft_erp, special.correction_m_s * step_s_ / geom.depth);
    join(contact, dGeomGetBody(geom.g1), dGeomGetBody(geom.g2));
  }
  return geoms;
}

std::span<const dContactGeom> Contacts::find_boxes(dGeomID a, dGeomID b) {
  const std::span<dContactGeom> found = find(a, b);
  return is_upright(a) && is_upright(b) ? reduced(found) : found;
}

const dSurfaceParameters& Contacts::surface_of(Pair pair) const {
  return surfaces_[static_cast<std::size_t>(pair)];
}

void Contacts::join_at(const dContactGeom& geom, Pair pair) {
  dContact contact{};
  contact.surface = surface_of(pair);
  contact.geom = geom;
  join(contact, dGeomGetBody(geom.g1), dGeomGetBody(geom.g2));
}

std::span<dContactGeom> Contacts::find(dGeomID a, dGeomID b) {
  const int found = dCollide(a, b, max_contacts, found_.data(), sizeof(dContactGeom));
  return {found_.data(), static_cast<std::size_t>(found)};
}

void Contacts::stop_at(dBodyID body, const Vec3& at_m, const Vec3& normal, double approach_m_s, Pair pair) {
  dContact contact{};
  contact.surface = surfaces_[static_cast<std::size_t>(pair)];
  contact.surface.mode |= dContactMotionN;
  contact.surface.motionN = -approach_m_s;
  std::ranges::copy(std::array{at_m.x, at_m.y, at_m.z}, contact.geom.pos);
  std::ranges::copy(std::array{normal.x, normal.y, normal.z}, contact.geom.normal);
  join(contact, body, nullptr);
}

// Each contact of a step a little softer than the one before.
void Contacts::join(dContact& contact, dBodyID a, dBodyID b) {
  contact.surface.soft_cfm *= 1.0 + tie_break * ++count_;
  dJointAttach(dJointCreateContact(world_, joints_.get(), &contact), a, b);
}

void Contacts::clear() {
  dJointGroupEmpty(joints_.get());
  count_ = 0;
}

}  // namespace striker::sil
