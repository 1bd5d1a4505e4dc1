// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/contacts.hpp"

#include <cmath>

namespace striker::sil {
namespace {

constexpr double shortest_axis = 1e-6;

}  // namespace

Contacts::Contacts(dWorldID world, double step_s) : world_(world), joints_(dJointGroupCreate(0)) {
  for (std::size_t i = 0; i < pair_count; ++i) {
    surfaces_.at(i) = surface(static_cast<Pair>(i), step_s);
  }
}

std::span<const dContactGeom> Contacts::collide(dGeomID a, dGeomID b, Pair pair, Vec2 friction_axis,
                                                std::optional<double> friction) {
  const int found = dCollide(a, b, max_contacts, found_.data(), sizeof(dContactGeom));
  if (found == 0) {
    return {};
  }
  dContact contact{};
  contact.surface = surfaces_[static_cast<std::size_t>(pair)];
  contact.surface.mu = friction.value_or(contact.surface.mu);
  const double soft_cfm = contact.surface.soft_cfm;
  const double length = std::hypot(friction_axis.x, friction_axis.y);
  if (length > shortest_axis) {
    contact.surface.mode |= dContactFDir1;
    contact.fdir1[0] = friction_axis.x / length;
    contact.fdir1[1] = friction_axis.y / length;
  }
  const std::span<const dContactGeom> geoms(found_.data(), static_cast<std::size_t>(found));
  for (const dContactGeom& geom : geoms) {
    contact.geom = geom;
    // Each contact of a step a little softer than the one before.
    contact.surface.soft_cfm = soft_cfm * (1.0 + tie_break * ++count_);
    dJointID joint = dJointCreateContact(world_, joints_.get(), &contact);
    dJointAttach(joint, dGeomGetBody(geom.g1), dGeomGetBody(geom.g2));
  }
  return geoms;
}

void Contacts::clear() {
  dJointGroupEmpty(joints_.get());
  count_ = 0;
}

}  // namespace striker::sil
