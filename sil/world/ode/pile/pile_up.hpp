// SPDX-License-Identifier: Apache-2.0
// Robots that press on each other in a crowd.
//
// To ODE's exact solver a crowd is one island, and its time grows with the island's size to the power of three:
// ten robots that press into a corner were 0.7 times as fast as real time. A crowd is therefore cut at its
// contacts: their forces come from a planar model of the crowd, in which motors, tyres, walls and bounces take
// part (planar_pile.hpp), and act on the full robots as forces from outside, each robot an island again. Two
// robots, one that is tilted, and one that lies on another keep exact contacts.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sil/world/ode/contacts.hpp"
#include "sil/world/ode/pile/planar_pile.hpp"
#include "sil/world/ode/robot.hpp"

namespace striker::sil {

class PileUp {
 public:
  // Of so many robots; whether a crowd is cut, or stays exact.
  PileUp(std::size_t robots, bool cuts);

  // A contact of this step; `b` none for a wall.
  void note(std::size_t a, std::optional<std::size_t> b, const dContactGeom& geom, Pair pair);

  // What a ball between them would let through: it has contacts of its own, and this is for the model alone.
  void note_through_ball(std::size_t a, std::optional<std::size_t> b, const dContactGeom& geom,
                         double approach_m_s);

  // Before the step: joins those of pairs, and pushes those of crowds. Forgets them.
  void act(std::span<const Robot> robots, Contacts& contacts, double step_s);
  // After it: the robots of crowds move on the plane as the model says. The tyres of the full robots do not hold
  // quite as the model's do, and a crowd would creep.
  void settle(std::span<const Robot> robots, double step_s) const;

 private:
  struct Touch {
    std::size_t a;
    std::optional<std::size_t> b;
    dContactGeom geom;
    Pair pair;
    std::optional<double> through_ball_m_s;  // the ball's room over the step
  };

  void find_crowds();
  [[nodiscard]] std::size_t crowd_of(std::size_t robot) const;
  [[nodiscard]] bool in_model(const Touch& touch) const;
  // Does the model alone act there?
  [[nodiscard]] bool is_cut(const Touch& touch) const;
  void push_apart(std::span<const Robot> robots, double step_s) const;
  void add_contact(const Touch& touch, const dSurfaceParameters& surface);
  void add_robots(std::span<const Robot> robots);

  bool cuts_;
  PlanarPile pile_;
  std::vector<Touch> touches_;
  std::vector<std::size_t> crowd_;                     // of each robot: a robot of the same one, or itself
  std::vector<std::size_t> size_;                      // of the crowd that a robot stands for
  std::vector<std::optional<std::size_t>> pile_body_;  // of each robot in a crowd
  std::vector<char> moved_;                            // by the model: each robot
};

}  // namespace striker::sil
