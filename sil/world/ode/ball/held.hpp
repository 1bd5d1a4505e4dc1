// SPDX-License-Identifier: Apache-2.0
// A ball held between robots, or between a robot and a wall.
//
// With the contact table as it is, such a ball throws robots about: a bounce asked of two contacts at once, and
// the depth of one turned into speed against the other, add energy (19.6 J were seen from a ball of 18 g, a
// robot at 7.9 m/s). While it is held its contacts therefore only resist: no bounce and no correction of depth.
// The forces of such a step take energy out or leave it, whatever the masses and directions: with f the contact
// forces, v and w the contacts' speeds before and after and A = J M^-1 J^T, the energy changes by
// f·w - f·A f / 2, and the solver's conditions leave f·w <= 0 when no speed is asked for.
#pragma once

#include <span>

#include "sil/world/ode/contacts.hpp"
#include "sil/world/ode/ode_world.hpp"
#include "sil/world/ode/pile/pile_up.hpp"
#include "sil/world/ode/robot.hpp"

namespace striker::sil {

// Is it, in the coming step? Two robots touch it, or one does and pushes it, or it flies, as far as a wall.
[[nodiscard]] bool is_held(const Ball& ball, std::span<const Robot> robots, bool has_walls, double step_s);

// Where the ball would reach a wall in the step, a contact that stops it there.
void join_held_ball_to_walls(const Ball& ball, Contacts& contacts, double step_s);

// Who presses on whom, or on a wall, through it: a crowd has to know.
void note_pushes_through(const Ball& ball, std::span<const Robot> robots, bool has_walls, double step_s,
                         PileUp& pile_up);

}  // namespace striker::sil
