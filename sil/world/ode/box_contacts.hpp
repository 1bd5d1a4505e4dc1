// SPDX-License-Identifier: Apache-2.0
// Two contacts for a face of a robot, where ODE gives up to eight: the exact solver's time grows with their number
// to the power of three, and ten robots in a corner are one island.
#pragma once

#include <ode/ode.h>

#include <span>

namespace striker::sil {

// The contacts of one pair of shapes in one or two of their number, in place. Seen from above they are split about
// the middle of the line on which they lie, across the normal; each end keeps its mean place. Its height is that of
// a standing robot's centre of mass, or as near to it as its contacts are: of all places of a face's pressure, the
// one at which a push tips no robot. ODE's corner points at 2 mm and 90 mm leave that to the solver.
[[nodiscard]] std::span<dContactGeom> reduced(std::span<dContactGeom> contacts);

}  // namespace striker::sil
