// SPDX-License-Identifier: Apache-2.0
//
// Lists typical faults planted in an exact method of collision detection (method.cpp), one per library that the tests
// build. `none` is the correct method.
#pragma once

namespace noli::mutants {

enum class Mutant {
  none,
  // Reading the input.
  single_precision,      ///< coordinates go through float
  subnormals_dropped,    ///< subnormal coordinates are replaced by zero
  moved_to_the_origin,   ///< the first point is subtracted from all, in double precision
  displacement_rounded,  ///< the end is the beginning plus a displacement, in double precision
  snapped_to_a_grid,     ///< coordinates are truncated to multiples of 2^-20
  coordinate_forgotten,  ///< the last point's z stays at its initial value
  corners_swapped,       ///< at the end of the step, two corners of the face are swapped
  edge_turned_round,     ///< at the end of the step, one of the edges is reversed
  // Early rejection.
  boxes_of_the_beginning,  ///< boxes are those at the beginning, not of the whole step
  boxes_must_overlap,      ///< boxes that only touch do not count
  same_sign_same_side,     ///< nothing happens when the volume has the same sign at both ends
  // When the four points are coplanar.
  sign_flipped,           ///< one term of the volume has the wrong sign
  cubic_term_dropped,     ///< the volume is treated as quadratic
  later_roots_dropped,    ///< only the first root is tested
  first_root_dropped,     ///< the first of several roots is not tested
  double_roots_dropped,   ///< roots at which the volume keeps its sign are not tested
  coplanar_dropped,       ///< features that stay coplanar never meet
  coplanar_at_ends_only,  ///< features that stay coplanar are only tested at the ends of the step
  beginning_excluded,     ///< contact at t = 0 does not count
  end_excluded,           ///< contact at t = 1 does not count
  tolerance_of_time,      ///< contact in the last millionth of the step does not count
  // Whether they meet at that time.
  border_excluded,           ///< contact at the border of the face and at ends of edges does not count
  tolerance_shrinks,         ///< nor does contact within a millionth of the border
  weights_at_the_beginning,  ///< the weights of the features are those at t = 0
  root_rounded,              ///< the weights are those at the root rounded to double
  parallel_edges_dropped,    ///< parallel edges never meet
  parallel_inside_dropped,   ///< an edge does not meet a parallel one that lies within it
  degenerate_face_dropped,   ///< a face without area never meets anything
  edges_prolonged,           ///< the second edge is treated as a line
  // The answer.
  one_ulp_late,           ///< the time is the next double
  rounded_to_nearest,     ///< the time is the nearest double, not the one before
  time_in_single,         ///< the time goes through float
  last_contact,           ///< of several contacts the last one is returned
  no_time_when_coplanar,  ///< no time (NaN) for features that stay coplanar
  // No return.
  endless_at_double_roots,  ///< the search for a double root does not end
  crash_at_three_roots      ///< there is only space for two roots
};

/// The fault of this library.
extern const Mutant chosen;

}  // namespace noli::mutants
