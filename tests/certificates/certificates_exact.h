// SPDX-License-Identifier: Apache-2.0
//
// Decides exactly whether two features whose points follow chords come within a distance of each other during a piece
// of time. It uses the kernel's polynomials (kernel/distance_parts.h), with the ends of the piece as rational numbers.
//
// Notation: that of kernel/motion.h; a chord is the line between two breakpoints.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "certificates/stencil.h"
#include "certificates/vector.h"
#include "kernel/arithmetic/algebraic.h"
#include "kernel/arithmetic/scaled_integers.h"
#include "kernel/distance_parts.h"

namespace noli::certificates::test {

/// A chord from x0 at t0 to x1 at t1, t0 < t1.
template <int Dim>
struct MotionSegment {
  double t0 = 0, t1 = 0;
  Vector<Dim> x0 = Vector<Dim>::Zero(), x1 = Vector<Dim>::Zero();

  /// The position in double precision. The error is at most 13 units of 2^-53 of the largest coordinate at the ends.
  Vector<Dim> at(double t) const { return x0 + ((t - t0) / (t1 - t0)) * (x1 - x0); }
};

namespace detail {

/// The powers of two that turn times and coordinates into integers.
struct Scale {
  exact::ExponentRange time, space;
};

template <int Dim>
Scale scale_of(std::span<const MotionSegment<Dim>> chords, double begin, double end, double eta) {
  Scale scale;
  scale.time.add(begin);
  scale.time.add(end);
  scale.space.add(eta);
  for (const MotionSegment<Dim>& chord : chords) {
    scale.time.add(chord.t0);
    scale.time.add(chord.t1);
    for (int d = 0; d < Dim; ++d) {
      scale.space.add(chord.x0[d]);
      scale.space.add(chord.x1[d]);
    }
  }
  return scale;
}

/// The coordinate d at time t, times (t1 - t0).
template <int Dim>
Integer place(const MotionSegment<Dim>& chord, int d, double t, const Scale& scale) {
  const Integer time = exact::coordinate<Integer>(t, scale.time);
  return (exact::coordinate<Integer>(chord.t1, scale.time) - time) *
             exact::coordinate<Integer>(chord.x0[d], scale.space) +
         (time - exact::coordinate<Integer>(chord.t0, scale.time)) *
             exact::coordinate<Integer>(chord.x1[d], scale.space);
}

struct At {
  const AlgebraicNumber& t;
  int sign(const Polynomial& p) const { return t.sign_of(p); }
};

inline bool within(const std::vector<distance::Part>& parts, const AlgebraicNumber& t) {
  return std::any_of(parts.begin(), parts.end(), [&t](const auto& part) { return part.within(At{t}); });
}

template <FeaturePair Pair, int Dim>
bool comes_within(std::span<const MotionSegment<Dim>> chords, double begin, double end, double eta) {
  const Scale scale = scale_of(chords, begin, end, eta);
  std::array<Integer, point_count(Pair)> lengths;
  Integer common(1);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    lengths[i] =
        exact::coordinate<Integer>(chords[i].t1, scale.time) - exact::coordinate<Integer>(chords[i].t0, scale.time);
    common *= lengths[i];
  }
  std::array<distance::Vector<Dim>, point_count(Pair)> x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Integer factor = divide_exactly(common, lengths[i]);
    for (int d = 0; d < Dim; ++d) {
      x[i][static_cast<std::size_t>(d)] =
          from_form({factor * place(chords[i], d, begin, scale), factor * place(chords[i], d, end, scale)});
    }
  }
  const Integer bound = common * exact::coordinate<Integer>(eta, scale.space);
  const auto parts = distance::parts_of<Pair, Dim>(x, bound * bound);
  if (within(parts, AlgebraicNumber())) return true;
  // The first time is the beginning or a root of an excess: see kernel/thickness.cpp.
  for (const auto& part : parts) {
    if (part.excess.is_zero()) continue;
    for (const AlgebraicNumber& t : roots_in_unit_interval(part.excess)) {
      if (within(parts, t)) return true;
    }
  }
  return false;
}

}  // namespace detail

/// Whether the distance is <= eta at some time in [begin, end]. Preconditions: all numbers are finite, eta >= 0, t0 <=
/// begin < end <= t1 for each chord; in the plane no faces and no edge against edge.
template <int Dim>
bool comes_within(FeaturePair kind, std::span<const MotionSegment<Dim>> chords, double begin, double end, double eta) {
  if constexpr (Dim == 3) {
    if (kind == FeaturePair::vertex_face) {
      return detail::comes_within<FeaturePair::vertex_face, 3>(chords, begin, end, eta);
    }
    if (kind == FeaturePair::edge_edge) {
      return detail::comes_within<FeaturePair::edge_edge, 3>(chords, begin, end, eta);
    }
  }
  if (kind == FeaturePair::vertex_edge) {
    return detail::comes_within<FeaturePair::vertex_edge, Dim>(chords, begin, end, eta);
  }
  return detail::comes_within<FeaturePair::vertex_vertex, Dim>(chords, begin, end, eta);
}

}  // namespace noli::certificates::test
