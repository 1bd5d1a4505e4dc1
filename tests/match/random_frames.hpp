// SPDX-License-Identifier: Apache-2.0
// A match as nobody plays it: bodies jump, and stay where they are long enough for every rule's time to come. Draws
// favour the places and borders that rules ask for.
#pragma once

#include <cmath>

#include "sil/match/referee/formations.hpp"
#include "sil/world/random.hpp"
#include "tests/match/played_match.hpp"

namespace striker::sil {

class RandomFrames {
 public:
  explicit RandomFrames(std::uint64_t seed) : random_(seed, 0, 0) {}

  // What is seen 50 ms after this ruling on the frame before.
  const RefereeFrame& after(const Ruling& ruling) {
    if (random_.below(8) != 0) {
      follow(ruling, frame_);  // else the placements were lost
    }
    if (random_.below(40) == 0) {
      frame_.ball.position_m = spot();
    }
    if (random_.below(50) == 0) {
      frame_.ball.speed_m_s = random_.below(2) == 0 ? random_.uniform(0.0, 0.4) : random_.uniform(0.3, 5.0);
    }
    frame_.touching.reset();
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      if (random_.below(120) == 0) {
        place(robot);
      }
      if (random_.below(frame_.standing[robot] ? 400 : 60) == 0) {
        frame_.standing.flip(robot);
      }
      frame_.touching.set(robot, random_.below(150) == 0);
    }
    return frame_;
  }

 private:
  void place(std::size_t robot) {
    const Vec2 at = spot();
    frame_.robots[robot] = {at.x, at.y, random_.uniform(-3.0, 3.0)};
    if (random_.below(3) == 0) {  // into a crowd
      frame_.robots[robot].x_m = std::copysign(random_.uniform(3.0, 3.9), frame_.ball.position_m.x);
      frame_.robots[robot].y_m = random_.uniform(-0.9, 0.9);
    } else if (random_.below(6) == 0) {  // in somebody's way
      const Pose home = home_spot(random_.below(robots_a_team));
      frame_.robots[robot] = random_.below(2) == 0 ? home : turned(home);
    }
  }

  // In a strip or area that a rule asks for, or anywhere. Never exactly on a line of symmetry.
  Vec2 spot() {
    const double x_sign = random_.below(2) == 0 ? 1.0 : -1.0;
    const double y_sign = random_.below(2) == 0 ? 1.0 : -1.0;
    switch (random_.below(12)) {
      case 6:
        return {x_sign * random_.uniform(3.8, 3.92), y_sign * random_.uniform(2.24, 2.34)};
      case 0:  // in a goal, or beside it
        return {x_sign * random_.uniform(3.85, 4.4), y_sign * random_.uniform(0.0, 0.6)};
      case 1:
      case 2:  // in a penalty area
        return {x_sign * random_.uniform(2.9, 3.9), y_sign * random_.uniform(0.0, 1.0)};
      case 3:  // in a goal area
        return {x_sign * random_.uniform(3.5, 3.9), y_sign * random_.uniform(0.0, 0.65)};
      case 4:  // in a corner, or beyond
        return {x_sign * random_.uniform(3.0, 3.95), y_sign * random_.uniform(0.9, 2.4)};
      case 5:  // over a side line
        return {random_.uniform(-3.0, 3.0), y_sign * random_.uniform(2.3, 2.4)};
      default:
        return {x_sign * random_.uniform(0.0, 3.9), y_sign * random_.uniform(0.0, 2.3)};
    }
  }

  Random random_;
  RefereeFrame frame_;
};

}  // namespace striker::sil
