// SPDX-License-Identifier: Apache-2.0
//
// Motions whose answer hangs on last bits, for audit/fuzz/trajectories/motion_generators.h: no whole numbers and no
// disguise that rounds. The oracle judges them; nothing is planted.
#pragma once

#include "audit/fuzz/random.h"
#include "audit/fuzz/trajectories/whole_motion.h"

namespace noli::audit {

/// Contact in the last instants of a step, at whose end everything lies in one plane (in 2D on one line), so that the
/// determinant vanishes there too; or in the first instants, with that root at the beginning.
GeneratedMotion last_ulp(Random& random);

/// Coordinates up to the greatest double, alone or beside tiny ones.
GeneratedMotion huge(Random& random);

/// Something comes to rest on something, a few units in the last place off, and stays there for some frames.
GeneratedMotion landing(Random& random);

}  // namespace noli::audit
