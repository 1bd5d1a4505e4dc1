// SPDX-License-Identifier: Apache-2.0
// Collision tests, and ODE's contact joints of one step.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>

#include "sil/world/ode/handles.hpp"
#include "sil/world/ode/materials.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

// Where the pair's surfaces say too little.
struct SpecialContact {
  // A horizontal direction along one side of the friction pyramid, of any length; {0, 0} leaves it to ODE,
  // which takes the world's axes on the floor.
  Vec2 friction_axis{};
  std::optional<double> friction{};  // Coulomb's coefficient
  // Depth is turned into speed no faster than this.
  double correction_m_s = std::numeric_limits<double>::infinity();
};

class Contacts {
 public:
  Contacts(dWorldID world, double step_s);
  // Memory for so many contacts in a step, once.
  void reserve(int contacts);

  // Tests one pair of shapes and joins them where they meet. Normals point from b to a. The result holds until
  // the next call.
  std::span<const dContactGeom> collide(dGeomID a, dGeomID b, Pair pair, const SpecialContact& special = {});

  // A robot's box against a wall or another box: while they are upright at most two contacts, at the ends of where they meet and at the
  // height of a standing robot's centre of mass if they meet there (box_contacts.hpp). For pairs whose depth is
  // not corrected.
  std::span<const dContactGeom> find_boxes(dGeomID a, dGeomID b);
  void join_at(const dContactGeom& geom, Pair pair);
  [[nodiscard]] const dSurfaceParameters& surface_of(Pair pair) const;

  // Stops the body, whose nearest point to a fixed surface is `at_m`, from coming nearer than at `approach_m_s`
  // along the surface's unit normal.
  void stop_at(dBodyID body, const Vec3& at_m, const Vec3& normal, double approach_m_s, Pair pair);

  // After each step.
  void clear();

 private:
  static constexpr std::size_t max_contacts = 10;  // kept of a pair, as Webots does

  dWorldID world_;
  double step_s_;
  JointGroupHandle joints_;
  std::array<dSurfaceParameters, pair_count> surfaces_{};
  std::array<dContactGeom, max_contacts> found_{};
  std::span<dContactGeom> find(dGeomID a, dGeomID b);
  void join(dContact& contact, dBodyID a, dBodyID b);

  int count_ = 0;  // in this step
};

}  // namespace striker::sil
