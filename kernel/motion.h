// SPDX-License-Identifier: Apache-2.0
//
// Finds exactly when two features first meet, if each of their points moves linearly over a time span of its own.
//
// Notation
//   path    a point that moves linearly from x_t0 at t0 to x_t1 at t1: a segment of a world line
//   piece   [begin, end]: a time span within the paths of all points of a query, so that all move linearly in it
//   s       (t - begin) / (end - begin), in [0, 1] for t in the piece
//
// A position at an end of the piece is x_t0 + (t - t0) / (t1 - t0) (x_t1 - x_t0), a rational number. All coordinates
// are brought to a common denominator, which changes neither contact nor its time, and then decided as integers.
//
// It takes tens of microseconds, with allocation. If all paths begin and end with the piece, include/noli/contact.h
// decides contact faster.
#pragma once

#include <array>
#include <optional>

#include <noli/query.h>
#include <noli/time_of_impact.h>

namespace noli {

template <int Dim>
struct LinearPath {
  double t0, t1;
  Point<Dim> x_t0, x_t1;
};

/// Two features over a piece of time. Preconditions: everything is finite; t0 <= begin < end <= t1 for all paths.
template <FeaturePair Pair, int Dim>
struct MotionQuery {
  std::array<LinearPath<Dim>, point_count(Pair)> paths;  ///< in the order of include/noli/query.h
  double begin, end;
};

/// The first contact within the piece, its time as s; or nothing.
template <FeaturePair Pair, int Dim>
std::optional<FirstContact> first_contact(const MotionQuery<Pair, Dim>& query);

/// The kind of a contact at the border of two consecutive pieces. It is crossing if the orientation determinant has
/// opposite signs just before and just after the border (and the other conditions of include/noli/time_of_impact.h
/// hold), persistent if it lasts for some time after it, else touching. Preconditions: before.end == after.begin; the
/// points are at the same places then; the features meet then, and at no earlier time of `before`.
template <FeaturePair Pair, int Dim>
ContactKind kind_at_border(const MotionQuery<Pair, Dim>& before, const MotionQuery<Pair, Dim>& after);

}  // namespace noli
