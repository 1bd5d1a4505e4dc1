// SPDX-License-Identifier: Apache-2.0
// The forces with which robots press on each other and on walls, for robots that stand on their wheels.
//
// Everything is on the plane: a robot is a body with three speeds, held by its tyres. Rows that may push or hold
// are solved by projected Gauss-Seidel from zero impulses (Catto, "Iterative dynamics with temporal coherence",
// 2005), so a step depends on nothing before it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "sil/world/vec3.hpp"

namespace striker::sil {

// How a wheel pulls along the robot's heading: towards a rim speed, with no more than this force either way.
struct PlanarDrive {
  double rim_speed_m_s;
  double force_N;
};

struct PileRobot {
  Pose pose;
  Vec2 velocity_m_s;
  double yaw_rate_rad_s;
  double mass_along_kg;  // with the wheels' spin
  double mass_across_kg;
  double inertia_kg_m2;
  double half_axle_m;
  std::array<PlanarDrive, 2> drives;  // left, right
  double grip_N;                      // across, of both tyres
};

struct PlanarContact {
  std::size_t a;
  std::optional<std::size_t> b;  // none: a wall
  Vec2 at_m;
  Vec2 normal;  // towards a
  double bounce;
  double friction;
  double part_m_s;  // at least so fast: depth is taken out; negative: there is room
};

class PlanarPile {
 public:
  PlanarPile();

  void clear();
  std::size_t add(const PileRobot& robot);
  void add(const PlanarContact& contact);

  // The impulses of a step. No allocation once the largest pile has been.
  void solve(double step_s);

  // Of the last solve, on robot a of a contact, in the order of adding; b takes the opposite.
  [[nodiscard]] Vec2 impulse_Ns(std::size_t contact) const;
  // How fast the pile then moves.
  [[nodiscard]] const Vec3& speeds_after(std::size_t robot) const { return bodies_[robot].speeds; }

 private:
  // Speeds and lines of action as {x, y, turn}.
  struct Body {
    PileRobot robot;
    Vec3 speeds;
  };
  struct Row {
    std::size_t a = 0;
    std::optional<std::size_t> b{};
    Vec3 line_a{};
    Vec3 line_b{};
    Vec3 yield_a{};  // the speeds that an impulse of 1 gives
    Vec3 yield_b{};
    double mass_kg = 0.0;
    double speed_m_s = 0.0;              // asked for
    double limit_Ns = 0.0;               // of a row that pulls both ways
    std::optional<std::size_t> grips{};  // friction: limit_Ns is times the impulse of this row
    bool pushes_only = false;
    double impulse_Ns = 0.0;
  };

  [[nodiscard]] Vec3 yield(std::size_t body, const Vec3& line) const;
  [[nodiscard]] double speed_along(const Row& row) const;
  void add_row(std::size_t a, std::optional<std::size_t> b, Vec2 at_m, Vec2 direction, Row row);
  void add_traction(std::size_t body, double step_s);
  void add_contact_rows(const PlanarContact& contact);
  void relax(Row& row);

  std::vector<Body> bodies_;
  std::vector<PlanarContact> contacts_;
  std::vector<Row> rows_;
  std::size_t first_contact_row_ = 0;
};

}  // namespace striker::sil
