// SPDX-License-Identifier: Apache-2.0
// Collision tests, and ODE's contact joints of one step.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "sil/world/ode/handles.hpp"
#include "sil/world/ode/materials.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

class Contacts {
 public:
  Contacts(dWorldID world, double step_s);

  // Tests one pair of shapes and joins them where they meet. Normals point from b to a. `friction_axis` is a
  // horizontal direction along one side of the friction pyramid, of any length; {0, 0} leaves it to ODE,
  // which takes the world's axes on the floor. `friction` is Coulomb's coefficient where it is not the pair's. The
  // result holds until the next call.
  std::span<const dContactGeom> collide(dGeomID a, dGeomID b, Pair pair, Vec2 friction_axis = {},
                                        std::optional<double> friction = {});

  // After each step.
  void clear();

 private:
  static constexpr std::size_t max_contacts = 10;  // kept of a pair, as Webots does

  dWorldID world_;
  JointGroupHandle joints_;
  std::array<dSurfaceParameters, pair_count> surfaces_{};
  std::array<dContactGeom, max_contacts> found_{};
  int count_ = 0;  // in this step
};

}  // namespace striker::sil
