// SPDX-License-Identifier: Apache-2.0
//
// Faults that are planted in an exact method of collision detection (method.cpp), one in each library that the tests
// build: what people get wrong. `none` is the method as it should be.
#pragma once

namespace noli::mutants {

enum class Mutant {
  none,
  // What is read.
  single_precision,      ///< coordinates go through float
  subnormals_dropped,    ///< subnormal coordinates are taken for zero
  moved_to_the_origin,   ///< the first point is subtracted from all, in double precision
  displacement_rounded,  ///< the end is the beginning plus a displacement, in double precision
  snapped_to_a_grid,     ///< coordinates are cut to multiples of 2^-20
  coordinate_forgotten,  ///< the last point's z is that of the beginning throughout
  corners_swapped,       ///< at the end of the step two corners of the face have changed places
  edge_turned_round,     ///< at the end of the step one of the edges runs the other way
  // What is left out at once.
  boxes_of_the_beginning,  ///< the boxes that have to overlap are not those of the whole step
  boxes_must_overlap,      ///< boxes that only touch do not count
  same_sign_same_side,     ///< nothing happens when the volume has the same sign at both ends
  // When the four points are coplanar.
  sign_flipped,           ///< one term of the volume has the wrong sign
  cubic_term_dropped,     ///< the volume is taken for quadratic
  later_roots_dropped,    ///< only the first root is looked at
  first_root_dropped,     ///< the first of several roots is not looked at
  double_roots_dropped,   ///< roots at which the volume keeps its sign are not looked at
  coplanar_dropped,       ///< what is coplanar throughout never meets
  coplanar_at_ends_only,  ///< of what is coplanar throughout only the two ends of the step are looked at
  beginning_excluded,     ///< a contact at t = 0 is none
  end_excluded,           ///< a contact at t = 1 is none
  tolerance_of_time,      ///< a contact in the last millionth of the step is none
  // Whether they meet then.
  border_excluded,           ///< the border of the face and the ends of edges are not met
  tolerance_shrinks,         ///< what lies within a millionth of the border is not met either
  weights_at_the_beginning,  ///< the place within the features is that of t = 0
  root_rounded,              ///< the place is that of the root rounded to double
  parallel_edges_dropped,    ///< parallel edges never meet
  parallel_inside_dropped,   ///< an edge does not meet a parallel one that lies within it
  degenerate_face_dropped,   ///< a face without an area is never met
  edges_prolonged,           ///< the second edge is taken for a line
  // What is told.
  one_ulp_late,           ///< the time is the next double
  rounded_to_nearest,     ///< the time is the nearest double, not the one before
  time_in_single,         ///< the time goes through float
  last_contact,           ///< of several contacts the last one is told
  no_time_when_coplanar,  ///< no time at all (NaN) for what is coplanar throughout
  // What does not come back.
  endless_at_double_roots,  ///< the search for a double root does not end
  crash_at_three_roots      ///< there is room for two roots
};

/// The fault of this library.
extern const Mutant chosen;

}  // namespace noli::mutants
