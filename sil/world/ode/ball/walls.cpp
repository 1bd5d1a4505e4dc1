// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/ball/walls.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "sil/world/field_specs.hpp"

namespace striker::sil {
namespace {

// The centre stays where normal · centre >= bound_m.
struct Plane {
  Vec3 normal;
  double bound_m;
};

constexpr double diagonal = 0.5 * std::numbers::sqrt2;
constexpr double corner_m = (field_half_length_m + field_half_width_m - corner_leg_m) * diagonal;

constexpr std::array<Plane, 9> planes = {{
    {.normal = {0.0, 1.0, 0.0}, .bound_m = ball_radius_m - field_half_width_m},
    {.normal = {0.0, -1.0, 0.0}, .bound_m = ball_radius_m - field_half_width_m},
    {.normal = {1.0, 0.0, 0.0}, .bound_m = ball_radius_m - goal_back_m},
    {.normal = {-1.0, 0.0, 0.0}, .bound_m = ball_radius_m - goal_back_m},
    {.normal = {diagonal, diagonal, 0.0}, .bound_m = ball_radius_m - corner_m},
    {.normal = {diagonal, -diagonal, 0.0}, .bound_m = ball_radius_m - corner_m},
    {.normal = {-diagonal, diagonal, 0.0}, .bound_m = ball_radius_m - corner_m},
    {.normal = {-diagonal, -diagonal, 0.0}, .bound_m = ball_radius_m - corner_m},
    {.normal = {0.0, 0.0, -1.0}, .bound_m = ball_radius_m - ball_ceiling_m},
}};

// An end block's quadrant: solid where depth > 0 (behind the end line) and aside > 0 (beside the goal).
struct BlockSide {
  double x;
  double y;
};
constexpr std::array<BlockSide, 4> blocks = {
    {{.x = -1.0, .y = -1.0}, {.x = -1.0, .y = 1.0}, {.x = 1.0, .y = -1.0}, {.x = 1.0, .y = 1.0}}};
static_assert(planes.size() + blocks.size() == ball_wall_count);

struct InBlock {
  double depth;
  double aside;
};

InBlock place_at(const Vec3& centre_m, const BlockSide& side) {
  return {.depth = side.x * centre_m.x - field_half_length_m,
          .aside = side.y * centre_m.y - goal_half_width_m};
}

WallGap gap_to(const Plane& plane, const Vec3& centre_m) {
  return {.gap_m = dot(plane.normal, centre_m) - plane.bound_m, .normal = plane.normal};
}

WallGap gap_to(const BlockSide& side, const Vec3& centre_m) {
  const InBlock at = place_at(centre_m, side);
  if (at.depth < 0.0 && at.aside < 0.0) {  // nearest to the post's edge
    const double distance_m = std::hypot(at.depth, at.aside);
    return {.gap_m = distance_m - ball_radius_m,
            .normal = {side.x * at.depth / distance_m, side.y * at.aside / distance_m, 0.0}};
  }
  // Outside by the one that is negative; inside, the nearer face.
  if (at.depth < at.aside) {
    return {.gap_m = -at.depth - ball_radius_m, .normal = {-side.x, 0.0, 0.0}};
  }
  return {.gap_m = -at.aside - ball_radius_m, .normal = {0.0, -side.y, 0.0}};
}

std::optional<WallHit> nearer(const std::optional<WallHit>& a, const std::optional<WallHit>& b) {
  return !a || (b && b->share < a->share) ? b : a;
}

// On the way, or at once from where it touches.
std::optional<WallHit> reach(const WallGap& wall, const Vec3& way_m) {
  const double approach_m = -dot(wall.normal, way_m);
  if (approach_m <= 0.0 || wall.gap_m > approach_m) {
    return {};
  }
  return WallHit{.share = std::max(0.0, wall.gap_m) / approach_m, .normal = wall.normal};
}

// The post is round to the ball's centre: a quarter of a circle about the block's edge.
std::optional<WallHit> reach_edge(const InBlock& at, const InBlock& way, const BlockSide& side) {
  const double squared = way.depth * way.depth + way.aside * way.aside;
  const double half_slope = at.depth * way.depth + at.aside * way.aside;
  const double apart = at.depth * at.depth + at.aside * at.aside - ball_radius_m * ball_radius_m;
  const double root = half_slope * half_slope - squared * apart;
  if (half_slope >= 0.0 || root < 0.0) {
    return {};
  }
  const double share = (-half_slope - std::sqrt(root)) / squared;
  const InBlock met{.depth = at.depth + share * way.depth, .aside = at.aside + share * way.aside};
  if (share > 1.0 || met.depth >= 0.0 || met.aside >= 0.0) {
    return {};
  }
  return WallHit{.share = share,
                 .normal = {side.x * met.depth / ball_radius_m, side.y * met.aside / ball_radius_m, 0.0}};
}

std::optional<WallHit> reach_block(const BlockSide& side, const Vec3& from_m, const Vec3& way_m) {
  const WallGap nearest = gap_to(side, from_m);
  if (nearest.gap_m <= 0.0) {
    return reach(nearest, way_m);
  }
  const InBlock at = place_at(from_m, side);
  const InBlock way{.depth = side.x * way_m.x, .aside = side.y * way_m.y};
  const auto front = reach({.gap_m = -at.depth - ball_radius_m, .normal = {-side.x, 0.0, 0.0}}, way_m);
  if (front && at.depth < 0.0 && at.aside + front->share * way.aside >= 0.0) {
    return front;
  }
  const auto inner = reach({.gap_m = -at.aside - ball_radius_m, .normal = {0.0, -side.y, 0.0}}, way_m);
  if (inner && at.aside < 0.0 && at.depth + inner->share * way.depth >= 0.0) {
    return inner;
  }
  return reach_edge(at, way, side);
}

}  // namespace

void wall_gaps(const Vec3& centre_m, std::span<WallGap, ball_wall_count> gaps) {
  auto gap = gaps.begin();
  for (const Plane& plane : planes) {
    *gap++ = gap_to(plane, centre_m);
  }
  for (const BlockSide& side : blocks) {
    *gap++ = gap_to(side, centre_m);
  }
}

std::optional<WallHit> first_wall_hit(const Vec3& from_m, const Vec3& way_m) {
  std::optional<WallHit> first;
  for (const Plane& plane : planes) {
    first = nearer(first, reach(gap_to(plane, from_m), way_m));
  }
  for (const BlockSide& side : blocks) {
    first = nearer(first, reach_block(side, from_m, way_m));
  }
  return first;
}

}  // namespace striker::sil
